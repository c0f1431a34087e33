// Movies: pictures piped into the program ffmpeg.
#pragma once

#include <sys/types.h>

#include <filesystem>

#include "suture/render/frame.hpp"

namespace suture {

class Movie {
 public:
  /// Starts ffmpeg. path ends in .mp4 (H.264) or .webm (VP9). width, height in pixels, both even; frames per second > 0.
  /// Throws InputError for another ending or size and when there is no ffmpeg, whose name may be given in the
  /// environment variable SUTURE_FFMPEG.
  Movie(std::filesystem::path path, int width, int height, int frames_per_second);
  /// Ends ffmpeg; without finish() no file is left.
  ~Movie();
  Movie(const Movie&) = delete;
  Movie& operator=(const Movie&) = delete;

  /// Throws InputError for pixels of another size, FileError when ffmpeg has died.
  void add(const Pixels& picture);
  /// Puts the complete file in its place. Throws FileError.
  void finish();

 private:
  void start(int frames_per_second);
  int end_program();  // exit code of ffmpeg

  std::filesystem::path path_, partial_;
  int width_, height_;
  int pipe_ = -1;
  pid_t program_ = -1;
};

}  // namespace suture
