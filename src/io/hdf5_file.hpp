// The only face of HDF5 in the library: hdf5_*.cpp alone include its header. Every return code is checked; failures are
// FileError. Files are written in the 1.8-compatible format (MATLAB R2022a, h5py, ParaView 5.11). A file counts only
// once finish() has returned: write it under a temporary name. Not for use from several threads at once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace suture {

/// Owns one HDF5 identifier of any kind.
class Hdf5Handle {
 public:
  Hdf5Handle() = default;
  explicit Hdf5Handle(std::int64_t id) : id_(id) {}
  Hdf5Handle(Hdf5Handle&& other) noexcept : id_(other.id_) { other.id_ = -1; }
  Hdf5Handle& operator=(Hdf5Handle&& other) noexcept;
  ~Hdf5Handle();
  std::int64_t id() const { return id_; }
  /// Gives the identifier away.
  std::int64_t release() { return std::exchange(id_, -1); }

 private:
  std::int64_t id_ = -1;
};

/// Unit and meaning of a dataset, stored as its attributes.
struct Hdf5Label {
  std::string_view unit;
  std::string_view description;
};

/// A group: named datasets, attributes and further groups. The methods that read throw FileError when the object is
/// missing, has another type or rank, or claims more bytes than the file holds.
class Hdf5Group {
 public:
  explicit Hdf5Group(Hdf5Handle handle) : handle_(std::move(handle)) {}

  Hdf5Group create_group(const std::string& name) const;
  Hdf5Group group(const std::string& name) const;
  bool has(const std::string& name) const;
  void remove(const std::string& name) const;
  /// Names of the members, in increasing order.
  std::vector<std::string> members() const;

  void write(const std::string& name, std::span<const double> values, const Hdf5Label& label) const;
  void write(const std::string& name, std::span<const int> values, const Hdf5Label& label) const;
  void write(const std::string& name, double value, const Hdf5Label& label) const;
  /// columns side by side: shape [length, columns.size()].
  void write_table(const std::string& name, std::span<const std::span<const double>> columns,
                   const Hdf5Label& label) const;
  void write_text(const std::string& name, std::string_view text, const Hdf5Label& label) const;

  /// Extends a one-dimensional dataset, which is created at the first call.
  void append(const std::string& name, std::span<const double> values, const Hdf5Label& label) const;
  void append(const std::string& name, std::span<const int> values, const Hdf5Label& label) const;
  /// The same for strings, cut at 31 characters.
  void append(const std::string& name, std::span<const std::string> values, const Hdf5Label& label) const;

  std::vector<double> doubles(const std::string& name) const;
  std::vector<int> integers(const std::string& name) const;
  std::vector<std::string> texts(const std::string& name) const;
  double number(const std::string& name) const;
  std::string text(const std::string& name) const;
  /// The columns of a [length, 2] dataset, one after the other: all x, then all y.
  std::vector<double> pairs(const std::string& name) const;
  /// Unit and description of a dataset.
  std::string unit_of(const std::string& name) const;
  std::string description_of(const std::string& name) const;

  void set_attribute(const std::string& name, std::string_view value) const;
  void set_attribute(const std::string& name, double value) const;
  void set_attribute(const std::string& name, std::int64_t value) const;
  bool has_attribute(const std::string& name) const;
  std::string text_attribute(const std::string& name) const;
  double number_attribute(const std::string& name) const;
  std::int64_t integer_attribute(const std::string& name) const;

 private:
  Hdf5Handle handle_;
};

/// A file on disk or in memory. Groups of it must be gone before it is finished or destroyed.
class Hdf5File {
 public:
  static Hdf5File create_in_memory();
  /// Replaces what is there.
  static Hdf5File create(const std::filesystem::path& path);
  /// For reading.
  static Hdf5File open(const std::filesystem::path& path);
  Hdf5Group root() const;
  /// The bytes of the file as it stands: a complete, closed HDF5 file.
  std::vector<std::byte> image() const;
  /// Writes what is still in buffers and closes the file. Throws also when data were lost on the way, in the closing of
  /// a dataset.
  void finish();

 private:
  explicit Hdf5File(Hdf5Handle handle);
  Hdf5Handle handle_;
  long failed_before_ = 0;  ///< closings that had failed when it was opened
};

}  // namespace suture
