#include "io/hdf5_file.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "io/hdf5_calls.hpp"
#include "suture/errors.hpp"

namespace suture {
namespace {

// Closing a dataset writes what HDF5 has kept in its buffers; destructors cannot say that this failed.
long failed_closings = 0;

constexpr std::size_t memory_increment = std::size_t{1} << 20;

// The innermost message of HDF5's own error stack, which says most.
herr_t keep_first(unsigned, const H5E_error2_t* record, void* target) {
  auto& text = *static_cast<std::string*>(target);
  if (text.empty() && record->desc != nullptr) text = record->desc;
  return 0;
}

// HDF5 prints its error stack by default; ours goes into the exception instead. And what it would do when the program
// exits can crash after a failed write (HDF5 1.10.8, full disk); everything we open we close ourselves.
void initialise() {
  static const bool ready = [] {
    H5dont_atexit();  // refused, harmlessly, when the library is already in use
    return H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr) >= 0;
  }();
  if (!ready) throw FileError("HDF5 could not be initialised");
}

/// How files on disk are opened. HDF5 would keep descriptions of up to 32 MiB of a file's objects, which take ten times that in
/// memory; files are read and written once, from one end to the other, so little need be kept.
Hdf5Handle disk_access() {
  Hdf5Handle access = own(H5Pcreate(H5P_FILE_ACCESS), "file access properties");
  // Published files are immutable (replaced by rename), and locks fail on some network file systems.
  check(H5Pset_file_locking(access.id(), /*use_file_locking=*/false, /*ignore_when_disabled=*/true), "file locking");
  H5AC_cache_config_t cache{};
  cache.version = H5AC__CURR_CACHE_CONFIG_VERSION;
  check(H5Pget_mdc_config(access.id(), &cache), "metadata cache");
  cache.set_initial_size = true;
  cache.initial_size = cache.min_size = cache.max_size = std::size_t{1} << 20;
  check(H5Pset_mdc_config(access.id(), &cache), "metadata cache");
  return access;
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

}  // namespace

void fail_hdf5(const std::string& what) {
  std::string reason;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep_first, &reason);
  H5Eclear2(H5E_DEFAULT);
  throw FileError(reason.empty() ? what : fmt::format("{} ({})", what, reason));
}

Hdf5Handle text_type(std::size_t length) {
  Hdf5Handle type = own(H5Tcopy(H5T_C_S1), "string type");
  check(H5Tset_size(type.id(), std::max<std::size_t>(length, 1)), "string type");
  return type;
}

void write_text_attribute(hid_t object, const std::string& name, std::string_view value) {
  const Hdf5Handle type = text_type(value.size());
  const Hdf5Handle space = own(H5Screate(H5S_SCALAR), name);
  const Hdf5Handle attribute =
      own(H5Acreate2(object, name.c_str(), type.id(), space.id(), H5P_DEFAULT, H5P_DEFAULT), "attribute " + name);
  std::string buffer(value);
  buffer.resize(std::max<std::size_t>(value.size(), 1));
  check(H5Awrite(attribute.id(), type.id(), buffer.data()), "attribute " + name);
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

Hdf5Handle& Hdf5Handle::operator=(Hdf5Handle&& other) noexcept {
  std::swap(id_, other.id_);
  return *this;
}

Hdf5Handle::~Hdf5Handle() {
  if (id_ >= 0 && H5Idec_ref(id_) < 0) ++failed_closings;
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

void Hdf5Group::set_attribute(const std::string& name, std::string_view value) const {
  write_text_attribute(handle_.id(), name, value);
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
  initialise();
  const Hdf5Handle access = own(H5Pcreate(H5P_FILE_ACCESS), "file access properties");
  check(H5Pset_fapl_core(access.id(), memory_increment, /*backing_store=*/false), "HDF5 core driver");
  return Hdf5File(
      own(H5Fcreate("suture-in-memory", H5F_ACC_TRUNC, H5P_DEFAULT, access.id()), "creating an HDF5 file in memory"));
}

Hdf5File Hdf5File::create(const std::filesystem::path& path) {
  initialise();
  const Hdf5Handle access = disk_access();
  return Hdf5File(own(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access.id()), "creating an HDF5 file"));
}

Hdf5File Hdf5File::open(const std::filesystem::path& path) {
  initialise();
  const Hdf5Handle access = disk_access();
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

Hdf5File::Hdf5File(Hdf5Handle handle) : handle_(std::move(handle)), failed_before_(failed_closings) {}

void Hdf5File::finish() {
  if (failed_closings != failed_before_) fail_hdf5("a write failed");
  check(H5Fflush(handle_.id(), H5F_SCOPE_GLOBAL), "flushing");
  check(H5Fclose(handle_.release()), "closing");
}

}  // namespace suture
