// A fingerprint of a whole file at its end, where HDF5 readers take no notice of it: 8 bytes "SUTUREOK", then the chained
// XXH3 hash of all bytes before (64 bits). It lets us refuse a damaged file before the HDF5 library sees it, which can
// crash on one (1.10.8: division by zero in the layout of a dataset, found by scripts/fuzz). A program that changes the
// file with HDF5 removes the seal; a file without one is read as it is.
#pragma once

#include <filesystem>

namespace suture {

/// Throws FileError.
void seal_file(const std::filesystem::path& path);
/// Throws FileError when the file has a seal and other bytes than those that were sealed.
void expect_unbroken_seal(const std::filesystem::path& path);

}  // namespace suture
