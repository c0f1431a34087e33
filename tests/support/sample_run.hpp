// A short run on disk, for tests of what shows it.
#pragma once

#include <filesystem>

namespace suture::test {

/// run.h5 with `frames` frames of sample_tissue(), which shrinks by 1 % from one to the next while its
/// rest lengths grow by 2 %, ten units of time apart from
/// t = 200 on; its wound shrinks with it, area 5 (1 - i/frames). The last frame has no purse string and no wound. One
/// event of kind "capture" per frame.
void write_sample_run(const std::filesystem::path& path, int frames = 4);

}  // namespace suture::test
