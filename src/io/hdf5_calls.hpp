// What the sources that talk to HDF5 share: return codes become FileError. Private to src/io/hdf5_*.cpp.
#pragma once

#include <hdf5.h>

#include <string>
#include <string_view>

#include "io/hdf5_file.hpp"

namespace suture {

/// Throws FileError with the innermost reason of HDF5's own error stack.
[[noreturn]] void fail_hdf5(const std::string& what);

template <class Status>
Status check(Status status, const std::string& what) {
  if (status < 0) fail_hdf5(what);
  return status;
}

inline Hdf5Handle own(hid_t id, const std::string& what) { return Hdf5Handle(check(id, what)); }

/// Fixed-length string.
Hdf5Handle text_type(std::size_t length);
void write_text_attribute(hid_t object, const std::string& name, std::string_view value);
std::string read_text_attribute(hid_t object, const std::string& name);

}  // namespace suture
