#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "io/hdf5_calls.hpp"
#include "io/hdf5_file.hpp"
#include "suture/errors.hpp"

namespace suture {
namespace {

constexpr std::size_t short_text_length = 32;  // with the terminating zero
constexpr hsize_t chunk_length = 1024;

hid_t memory_type(const double*) { return H5T_NATIVE_DOUBLE; }
hid_t memory_type(const int*) { return H5T_NATIVE_INT; }
hid_t file_type(const double*) { return H5T_IEEE_F64LE; }
hid_t file_type(const int*) { return H5T_STD_I32LE; }
void set_label(hid_t dataset, const Hdf5Label& label) {
  write_text_attribute(dataset, "unit", label.unit);
  write_text_attribute(dataset, "description", label.description);
}

Hdf5Handle create_dataset(hid_t group, const std::string& name, hid_t type, std::span<const hsize_t> dimensions,
                          const Hdf5Label& label) {
  const Hdf5Handle space =
      dimensions.empty() ? own(H5Screate(H5S_SCALAR), name)
                         : own(H5Screate_simple(static_cast<int>(dimensions.size()), dimensions.data(), nullptr), name);
  Hdf5Handle dataset =
      own(H5Dcreate2(group, name.c_str(), type, space.id(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), "creating " + name);
  set_label(dataset.id(), label);
  return dataset;
}

void write_all(const Hdf5Handle& dataset, hid_t type, const void* data, const std::string& name) {
  check(H5Dwrite(dataset.id(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data), "writing " + name);
}

template <class T>
void write_array(hid_t group, const std::string& name, std::span<const T> values, const Hdf5Label& label) {
  const std::array<hsize_t, 1> dimensions{values.size()};
  const Hdf5Handle dataset = create_dataset(group, name, file_type(values.data()), dimensions, label);
  if (!values.empty()) write_all(dataset, memory_type(values.data()), values.data(), name);
}

Hdf5Handle open_or_create_extensible(hid_t group, const std::string& name, hid_t type, const Hdf5Label& label) {
  if (check(H5Lexists(group, name.c_str(), H5P_DEFAULT), name) > 0)
    return own(H5Dopen2(group, name.c_str(), H5P_DEFAULT), "opening " + name);
  const hsize_t length = 0, unlimited = H5S_UNLIMITED, chunk = chunk_length;
  const Hdf5Handle space = own(H5Screate_simple(1, &length, &unlimited), name);
  const Hdf5Handle properties = own(H5Pcreate(H5P_DATASET_CREATE), name);
  check(H5Pset_chunk(properties.id(), 1, &chunk), name);
  Hdf5Handle dataset = own(H5Dcreate2(group, name.c_str(), type, space.id(), H5P_DEFAULT, properties.id(), H5P_DEFAULT),
                           "creating " + name);
  set_label(dataset.id(), label);
  return dataset;
}

void append_raw(hid_t group, const std::string& name, hid_t stored, hid_t in_memory, hsize_t count, const void* data,
                const Hdf5Label& label) {
  const Hdf5Handle dataset = open_or_create_extensible(group, name, stored, label);
  if (count == 0) return;
  hsize_t start = 0;
  {
    const Hdf5Handle space = own(H5Dget_space(dataset.id()), name);
    check(H5Sget_simple_extent_dims(space.id(), &start, nullptr), name);
  }
  const hsize_t length = start + count;
  check(H5Dset_extent(dataset.id(), &length), "extending " + name);
  const Hdf5Handle target = own(H5Dget_space(dataset.id()), name);
  check(H5Sselect_hyperslab(target.id(), H5S_SELECT_SET, &start, nullptr, &count, nullptr), name);
  const Hdf5Handle source = own(H5Screate_simple(1, &count, nullptr), name);
  check(H5Dwrite(dataset.id(), in_memory, source.id(), target.id(), H5P_DEFAULT, data), "writing " + name);
}

// A claimed size is believed only if the file could hold it: nothing we write is compressed.
struct OpenDataset {
  Hdf5Handle handle, type;
  std::vector<hsize_t> dimensions;
  std::size_t element_size = 0;
  std::size_t count = 1;
};

OpenDataset open_dataset(hid_t group, const std::string& name, std::size_t rank, H5T_class_t type_class) {
  OpenDataset open;
  open.handle = own(H5Dopen2(group, name.c_str(), H5P_DEFAULT), fmt::format("dataset '{}' is missing", name));
  open.type = own(H5Dget_type(open.handle.id()), name);
  if (H5Tget_class(open.type.id()) != type_class || H5Tis_variable_str(open.type.id()) > 0)
    throw FileError(fmt::format("dataset '{}' has an unexpected type", name));
  open.element_size = H5Tget_size(open.type.id());
  const Hdf5Handle space = own(H5Dget_space(open.handle.id()), name);
  const int found = check(H5Sget_simple_extent_ndims(space.id()), name);
  if (found != static_cast<int>(rank))
    throw FileError(fmt::format("dataset '{}' has {} dimensions; {} expected", name, found, rank));
  open.dimensions.resize(rank);
  if (rank > 0) check(H5Sget_simple_extent_dims(space.id(), open.dimensions.data(), nullptr), name);
  hsize_t file_size = 0;
  const Hdf5Handle file = own(H5Iget_file_id(open.handle.id()), name);
  check(H5Fget_filesize(file.id(), &file_size), name);
  hsize_t bytes = open.element_size;
  for (const hsize_t dimension : open.dimensions) {
    if (dimension != 0 && bytes > file_size / dimension)
      throw FileError(fmt::format("dataset '{}' claims more data than the file holds", name));
    bytes *= dimension;
    open.count *= dimension;
  }
  if (bytes > file_size) throw FileError(fmt::format("dataset '{}' claims more data than the file holds", name));
  return open;
}

template <class T>
std::vector<T> read_array(hid_t group, const std::string& name, std::size_t rank, H5T_class_t type_class,
                          std::vector<hsize_t>* dimensions = nullptr) {
  const OpenDataset open = open_dataset(group, name, rank, type_class);
  std::vector<T> values(open.count);
  if (!values.empty())
    check(H5Dread(open.handle.id(), memory_type(values.data()), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()),
          fmt::format("dataset '{}' cannot be read", name));
  if (dimensions != nullptr) *dimensions = open.dimensions;
  return values;
}

std::string label_of(hid_t group, const std::string& name, const std::string& attribute) {
  const Hdf5Handle object = own(H5Oopen(group, name.c_str(), H5P_DEFAULT), fmt::format("'{}' is missing", name));
  return read_text_attribute(object.id(), attribute);
}

}  // namespace

void Hdf5Group::write(const std::string& name, std::span<const double> values, const Hdf5Label& label) const {
  write_array(handle_.id(), name, values, label);
}

void Hdf5Group::write(const std::string& name, std::span<const int> values, const Hdf5Label& label) const {
  write_array(handle_.id(), name, values, label);
}

void Hdf5Group::write(const std::string& name, double value, const Hdf5Label& label) const {
  write_all(create_dataset(handle_.id(), name, H5T_IEEE_F64LE, {}, label), H5T_NATIVE_DOUBLE, &value, name);
}

void Hdf5Group::write_table(const std::string& name, std::span<const std::span<const double>> columns,
                            const Hdf5Label& label) const {
  const std::size_t width = columns.size(), length = columns.front().size();
  std::vector<double> rows(width * length);
  for (std::size_t column = 0; column < width; ++column)
    for (std::size_t row = 0; row < length; ++row) rows[row * width + column] = columns[column][row];
  const std::array<hsize_t, 2> dimensions{length, width};
  const Hdf5Handle dataset = create_dataset(handle_.id(), name, H5T_IEEE_F64LE, dimensions, label);
  if (!rows.empty()) write_all(dataset, H5T_NATIVE_DOUBLE, rows.data(), name);
}

void Hdf5Group::write_text(const std::string& name, std::string_view text, const Hdf5Label& label) const {
  const Hdf5Handle type = text_type(text.size());
  std::string buffer(text);
  buffer.resize(std::max<std::size_t>(text.size(), 1));
  write_all(create_dataset(handle_.id(), name, type.id(), {}, label), type.id(), buffer.data(), name);
}

void Hdf5Group::append(const std::string& name, std::span<const double> values, const Hdf5Label& label) const {
  append_raw(handle_.id(), name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, values.size(), values.data(), label);
}

void Hdf5Group::append(const std::string& name, std::span<const int> values, const Hdf5Label& label) const {
  append_raw(handle_.id(), name, H5T_STD_I32LE, H5T_NATIVE_INT, values.size(), values.data(), label);
}

void Hdf5Group::append(const std::string& name, std::span<const std::string> values, const Hdf5Label& label) const {
  const Hdf5Handle type = text_type(short_text_length);
  std::vector<char> buffer(values.size() * short_text_length, '\0');
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i].copy(buffer.data() + i * short_text_length, short_text_length - 1);
  append_raw(handle_.id(), name, type.id(), type.id(), values.size(), buffer.data(), label);
}

std::vector<double> Hdf5Group::doubles(const std::string& name) const {
  return read_array<double>(handle_.id(), name, 1, H5T_FLOAT);
}

std::vector<int> Hdf5Group::integers(const std::string& name) const {
  return read_array<int>(handle_.id(), name, 1, H5T_INTEGER);
}

double Hdf5Group::number(const std::string& name) const {
  return read_array<double>(handle_.id(), name, 0, H5T_FLOAT).front();
}

std::vector<double> Hdf5Group::pairs(const std::string& name) const {
  std::vector<hsize_t> dimensions;
  const std::vector<double> rows = read_array<double>(handle_.id(), name, 2, H5T_FLOAT, &dimensions);
  if (dimensions[1] != 2) throw FileError(fmt::format("dataset '{}' has {} columns; 2 expected", name, dimensions[1]));
  std::vector<double> columns(rows.size());
  const std::size_t length = rows.size() / 2;
  for (std::size_t i = 0; i < length; ++i) columns[i] = rows[2 * i], columns[length + i] = rows[2 * i + 1];
  return columns;
}

std::vector<std::string> Hdf5Group::texts(const std::string& name) const {
  const OpenDataset open = open_dataset(handle_.id(), name, 1, H5T_STRING);
  std::vector<char> buffer(open.count * open.element_size);
  if (!buffer.empty())
    check(H5Dread(open.handle.id(), open.type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, buffer.data()), name);
  std::vector<std::string> values;
  for (std::size_t i = 0; i < open.count; ++i) {
    const std::string_view padded(buffer.data() + i * open.element_size, open.element_size);
    values.emplace_back(padded.substr(0, padded.find('\0')));
  }
  return values;
}

std::string Hdf5Group::text(const std::string& name) const {
  const OpenDataset open = open_dataset(handle_.id(), name, 0, H5T_STRING);
  std::string value(open.element_size, '\0');
  check(H5Dread(open.handle.id(), open.type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, value.data()), name);
  value.resize(std::min(value.find('\0'), value.size()));
  return value;
}

std::string Hdf5Group::unit_of(const std::string& name) const { return label_of(handle_.id(), name, "unit"); }

std::string Hdf5Group::description_of(const std::string& name) const {
  return label_of(handle_.id(), name, "description");
}

}  // namespace suture
