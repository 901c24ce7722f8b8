#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lift_slam {

// A YAML or OpenCV XML file as a flat table: the path of keys ("cam0/intrinsics", "fx") leads to
// the values there, lists of lists in reading order. Every complaint names file, line and key.
class KeyedFile {
 public:
  // Accepts OpenCV's "%YAML:1.0" first line and its matrix tags; JSON is YAML too.
  // Throws InputError when the file cannot be read, is not valid, has no keys, holds a second
  // document, or is nested too deeply or too long for a calibration.
  static KeyedFile ReadYaml(const std::filesystem::path& path);
  // Elements and text only, as OpenCV's FileStorage writes; the root element is left out of keys.
  static KeyedFile ReadXml(const std::filesystem::path& path);

  bool Has(const std::string& key) const { return entries_.count(key) > 0; }
  // Whether any key lies below `prefix` + "/".
  bool HasGroup(const std::string& prefix) const;
  std::vector<std::string> Keys() const;
  const std::string& source() const { return source_; }

  // These throw InputError when the key is missing or its value is no finite number.
  std::string Text(const std::string& key) const;
  double Number(const std::string& key) const;
  int WholeNumber(const std::string& key) const;
  std::vector<double> Numbers(const std::string& key) const;
  std::vector<int> WholeNumbers(const std::string& key, std::size_t count) const;
  // The same number of values as asked for, or InputError.
  std::vector<double> Numbers(const std::string& key, std::size_t count) const;
  // Whether all its values are the number zero; true without values.
  bool AllZero(const std::string& key) const;
  // The fallback stands for an absent key only.
  double NumberOr(const std::string& key, double fallback) const;
  int WholeNumberOr(const std::string& key, int fallback) const;

  // Throws InputError "<file>:<line>: key '<key>': expected <expected>, found '<value>'".
  [[noreturn]] void Fail(const std::string& key, std::string_view expected) const;

 private:
  struct Entry {
    std::vector<std::string> values;
    int line = 0;
  };
  friend class YamlFlattener;
  friend class XmlFlattener;

  const Entry& At(const std::string& key) const;

  std::string source_;
  std::map<std::string, Entry> entries_;
};

}  // namespace lift_slam
