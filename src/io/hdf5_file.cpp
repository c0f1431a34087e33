#include "io/hdf5_file.hpp"

#include <fmt/format.h>
#include <hdf5.h>

#include <algorithm>
#include <array>

#include "suture/errors.hpp"

namespace suture {
namespace {

constexpr std::size_t short_text_length = 32;  // with the terminating zero
constexpr hsize_t chunk_length = 1024;
constexpr std::size_t memory_increment = std::size_t{1} << 20;

// The innermost message of HDF5's own error stack, which says most.
herr_t keep_first(unsigned, const H5E_error2_t* record, void* target) {
  auto& text = *static_cast<std::string*>(target);
  if (text.empty() && record->desc != nullptr) text = record->desc;
  return 0;
}

[[noreturn]] void fail(const std::string& what) {
  std::string reason;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep_first, &reason);
  H5Eclear2(H5E_DEFAULT);
  throw FileError(reason.empty() ? what : fmt::format("{} ({})", what, reason));
}

template <class Status>
Status check(Status status, const std::string& what) {
  if (status < 0) fail(what);
  return status;
}

Hdf5Handle own(hid_t id, const std::string& what) { return Hdf5Handle(check(id, what)); }

// HDF5 prints its error stack by default; ours goes into the exception instead.
void silence() {
  static const bool silenced = [] { return H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr) >= 0; }();
  if (!silenced) throw FileError("HDF5 could not be initialised");
}

hid_t memory_type(const double*) { return H5T_NATIVE_DOUBLE; }
hid_t memory_type(const int*) { return H5T_NATIVE_INT; }
hid_t file_type(const double*) { return H5T_IEEE_F64LE; }
hid_t file_type(const int*) { return H5T_STD_I32LE; }

Hdf5Handle text_type(std::size_t length) {
  Hdf5Handle type = own(H5Tcopy(H5T_C_S1), "string type");
  check(H5Tset_size(type.id(), std::max<std::size_t>(length, 1)), "string type");
  return type;
}

void set_text(hid_t object, const std::string& name, std::string_view value) {
  const Hdf5Handle type = text_type(value.size());
  const Hdf5Handle space = own(H5Screate(H5S_SCALAR), name);
  const Hdf5Handle attribute =
      own(H5Acreate2(object, name.c_str(), type.id(), space.id(), H5P_DEFAULT, H5P_DEFAULT), "attribute " + name);
  std::string buffer(value);
  buffer.resize(std::max<std::size_t>(value.size(), 1));
  check(H5Awrite(attribute.id(), type.id(), buffer.data()), "attribute " + name);
}

void set_label(hid_t dataset, const Hdf5Label& label) {
  set_text(dataset, "unit", label.unit);
  set_text(dataset, "description", label.description);
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

std::string read_text_attribute(hid_t object, const std::string& name) {
  const Hdf5Handle attribute =
      own(H5Aopen(object, name.c_str(), H5P_DEFAULT), fmt::format("attribute '{}' is missing", name));
  const Hdf5Handle type = own(H5Aget_type(attribute.id()), name);
  const Hdf5Handle space = own(H5Aget_space(attribute.id()), name);
  constexpr std::size_t attribute_limit = 65536;  // of the 1.8 file format
  if (H5Tget_class(type.id()) != H5T_STRING || H5Tis_variable_str(type.id()) > 0 ||
      H5Sget_simple_extent_npoints(space.id()) != 1 || H5Tget_size(type.id()) > attribute_limit)
    throw FileError(fmt::format("attribute '{}' is not a short text", name));
  std::string value(H5Tget_size(type.id()), '\0');
  check(H5Aread(attribute.id(), type.id(), value.data()), "attribute " + name);
  value.resize(std::min(value.find('\0'), value.size()));
  return value;
}

template <class T>
void set_scalar(hid_t object, const std::string& name, hid_t stored, hid_t in_memory, const T& value) {
  const bool exists = check(H5Aexists(object, name.c_str()), name) > 0;
  const Hdf5Handle space = own(H5Screate(H5S_SCALAR), name);
  const Hdf5Handle attribute =
      exists ? own(H5Aopen(object, name.c_str(), H5P_DEFAULT), "attribute " + name)
             : own(H5Acreate2(object, name.c_str(), stored, space.id(), H5P_DEFAULT, H5P_DEFAULT), "attribute " + name);
  check(H5Awrite(attribute.id(), in_memory, &value), "attribute " + name);
}

template <class T>
T read_scalar(hid_t object, const std::string& name, hid_t in_memory) {
  const Hdf5Handle attribute =
      own(H5Aopen(object, name.c_str(), H5P_DEFAULT), fmt::format("attribute '{}' is missing", name));
  const Hdf5Handle space = own(H5Aget_space(attribute.id()), name);
  if (H5Sget_simple_extent_npoints(space.id()) != 1)
    throw FileError(fmt::format("attribute '{}' is not a scalar", name));
  T value{};
  check(H5Aread(attribute.id(), in_memory, &value), fmt::format("attribute '{}' cannot be read", name));
  return value;
}

std::string label_of(hid_t group, const std::string& name, const std::string& attribute) {
  const Hdf5Handle object = own(H5Oopen(group, name.c_str(), H5P_DEFAULT), fmt::format("'{}' is missing", name));
  return read_text_attribute(object.id(), attribute);
}

}  // namespace

Hdf5Handle& Hdf5Handle::operator=(Hdf5Handle&& other) noexcept {
  std::swap(id_, other.id_);
  return *this;
}

Hdf5Handle::~Hdf5Handle() {
  if (id_ >= 0) H5Idec_ref(id_);
}

Hdf5Group Hdf5Group::create_group(const std::string& name) const {
  return Hdf5Group(own(H5Gcreate2(handle_.id(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), "group " + name));
}

Hdf5Group Hdf5Group::group(const std::string& name) const {
  return Hdf5Group(own(H5Gopen2(handle_.id(), name.c_str(), H5P_DEFAULT), fmt::format("group '{}' is missing", name)));
}

bool Hdf5Group::has(const std::string& name) const {
  return check(H5Lexists(handle_.id(), name.c_str(), H5P_DEFAULT), name) > 0;
}

void Hdf5Group::remove(const std::string& name) const {
  check(H5Ldelete(handle_.id(), name.c_str(), H5P_DEFAULT), "removing " + name);
}

std::vector<std::string> Hdf5Group::members() const {
  std::vector<std::string> names;
  const auto collect = [](hid_t, const char* name, const H5L_info_t*, void* target) -> herr_t {
    try {
      static_cast<std::vector<std::string>*>(target)->emplace_back(name);
    } catch (...) {  // must not cross the C frames of HDF5
      return -1;
    }
    return 0;
  };
  check(H5Literate(handle_.id(), H5_INDEX_NAME, H5_ITER_INC, nullptr, collect, &names), "the members of a group");
  return names;
}

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

void Hdf5Group::set_attribute(const std::string& name, std::string_view value) const {
  set_text(handle_.id(), name, value);
}

void Hdf5Group::set_attribute(const std::string& name, double value) const {
  set_scalar(handle_.id(), name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, value);
}

void Hdf5Group::set_attribute(const std::string& name, std::int64_t value) const {
  set_scalar(handle_.id(), name, H5T_STD_I64LE, H5T_NATIVE_INT64, value);
}

bool Hdf5Group::has_attribute(const std::string& name) const {
  return check(H5Aexists(handle_.id(), name.c_str()), name) > 0;
}

std::string Hdf5Group::text_attribute(const std::string& name) const { return read_text_attribute(handle_.id(), name); }

double Hdf5Group::number_attribute(const std::string& name) const {
  return read_scalar<double>(handle_.id(), name, H5T_NATIVE_DOUBLE);
}

std::int64_t Hdf5Group::integer_attribute(const std::string& name) const {
  return read_scalar<std::int64_t>(handle_.id(), name, H5T_NATIVE_INT64);
}

Hdf5File Hdf5File::create_in_memory() {
  silence();
  const Hdf5Handle access = own(H5Pcreate(H5P_FILE_ACCESS), "file access properties");
  check(H5Pset_fapl_core(access.id(), memory_increment, /*backing_store=*/false), "HDF5 core driver");
  return Hdf5File(
      own(H5Fcreate("suture-in-memory", H5F_ACC_TRUNC, H5P_DEFAULT, access.id()), "creating an HDF5 file in memory"));
}

Hdf5File Hdf5File::open(const std::filesystem::path& path) {
  silence();
  const Hdf5Handle access = own(H5Pcreate(H5P_FILE_ACCESS), "file access properties");
  // Published files are immutable (replaced by rename), and locks fail on some network file systems.
  check(H5Pset_file_locking(access.id(), /*use_file_locking=*/false, /*ignore_when_disabled=*/true), "file locking");
  return Hdf5File(own(H5Fopen(path.c_str(), H5F_ACC_RDONLY, access.id()), "it cannot be opened as an HDF5 file"));
}

Hdf5Group Hdf5File::root() const { return Hdf5Group(own(H5Gopen2(handle_.id(), "/", H5P_DEFAULT), "the root group")); }

std::vector<std::byte> Hdf5File::image() const {
  check(H5Fflush(handle_.id(), H5F_SCOPE_GLOBAL), "flushing");
  const ssize_t size = check(H5Fget_file_image(handle_.id(), nullptr, 0), "the file image");
  std::vector<std::byte> bytes(static_cast<std::size_t>(size));
  check(H5Fget_file_image(handle_.id(), bytes.data(), bytes.size()), "the file image");
  return bytes;
}

}  // namespace suture
