// Reading and writing the small tables of the figure programs.
#pragma once

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "suture/errors.hpp"

namespace suture::figures {

using CsvRow = std::map<std::string, std::string>;

/// The rows of a CSV file without quotes, by column name. Throws InputError.
inline std::vector<CsvRow> read_csv(const std::filesystem::path& path) {
  std::ifstream stream(path);
  std::string line, field;
  if (!std::getline(stream, line)) throw InputError(path.string() + ": no such file, or it is empty");
  std::vector<std::string> names;
  for (std::istringstream head(line); std::getline(head, field, ',');) names.push_back(field);
  std::vector<CsvRow> rows;
  while (std::getline(stream, line)) {
    CsvRow row;
    std::istringstream fields(line);
    for (const std::string& name : names)
      if (std::getline(fields, field, ',')) row[name] = field;
    if (row.size() != names.size())
      throw InputError(fmt::format("{}:{}: found {} fields, allowed {}", path.string(), rows.size() + 2, row.size(), names.size()));
    rows.push_back(std::move(row));
  }
  return rows;
}

inline double number(const CsvRow& row, const std::string& name) { return std::stod(row.at(name)); }

/// A CSV file that is complete once the object is gone.
class CsvFile {
 public:
  CsvFile(const std::filesystem::path& path, const std::string& header) : stream_(path) {
    if (!stream_) throw FileError(path.string() + ": cannot be written");
    stream_ << header << '\n';
  }
  template <class... Values>
  void row(const Values&... values) {
    std::string line;
    ((line += fmt::format("{}{}", line.empty() ? "" : ",", values)), ...);
    stream_ << line << '\n';
  }

 private:
  std::ofstream stream_;
};

/// What every figure program does: the folder for the results, then the folder with the published numbers.
template <class Draw>
int figure_main(int argc, char** argv, Draw draw) {
  if (argc < 3) {
    std::cerr << fmt::format("usage: {} OUTPUT_FOLDER PUBLISHED_FOLDER [...]\n", argv[0]);
    return 2;
  }
  try {
    std::filesystem::create_directories(argv[1]);
    draw(std::filesystem::path(argv[1]), std::filesystem::path(argv[2]), std::vector<std::string>(argv + 3, argv + argc));
    return 0;
  } catch (const InputError& error) {
    std::cerr << "error: " << error.what() << '\n';
    return 2;
  } catch (const std::exception& error) {
    std::cerr << "error: " << error.what() << '\n';
    return 3;
  }
}

}  // namespace suture::figures
