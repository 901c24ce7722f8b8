#include "lift_slam/datasets/distortion_keys.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>

namespace lift_slam {
namespace {

bool Contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::string LowerCase(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

bool NamesDistortion(const std::string& name) {
  const std::string lower = LowerCase(name);
  return lower.starts_with("dist") && !lower.starts_with("distance");
}

// What a matrix has beside its values.
bool IsMatrixHeader(const std::string& key) {
  return key.ends_with("/rows") || key.ends_with("/cols") || key.ends_with("/dt");
}

// k1, K_1, P2, kappa1.
bool NamesCoefficient(const std::string& name) {
  if (name.empty() || std::isdigit(static_cast<unsigned char>(name.back())) == 0) return false;
  const char first = LowerCase(name).front();
  return first == 'k' || first == 'p';
}

[[noreturn]] void Fail(const KeyedFile& file, const std::string& key, const std::string& prefix,
                       const std::vector<std::string>& known) {
  file.Fail(key, fmt::format("no such key; the distortion is read from {}{}", prefix,
                             fmt::join(known, ", " + prefix)));
}

// What follows "Camera." or "Camera1."; empty for other keys.
std::string OrbSlamName(const std::string& key) {
  const std::string lower = LowerCase(key);
  for (const std::string prefix : {"camera.", "camera1."}) {
    if (lower.starts_with(prefix)) return key.substr(prefix.size());
  }
  return "";
}

}  // namespace

void RefuseOtherDistortionKeys(const KeyedFile& file, const std::string& prefix,
                               const std::vector<std::string>& known) {
  for (const std::string& key : file.Keys()) {
    if (!key.starts_with(prefix) || IsMatrixHeader(key)) continue;
    const std::string rest = key.substr(prefix.size());
    const std::string name = rest.substr(0, rest.find('/'));
    if (!NamesDistortion(name) || Contains(known, name) || file.AllZero(key)) continue;
    Fail(file, key, prefix, known);
  }
}

void RefuseOtherOrbSlamCoefficients(const KeyedFile& file, const std::string& prefix,
                                    const std::vector<std::string>& known) {
  for (const std::string& key : file.Keys()) {
    const std::string name = OrbSlamName(key);
    if (!NamesDistortion(name) && !NamesCoefficient(name)) continue;
    // A file for both generations gives the known ones with either prefix.
    if (Contains(known, name) && file.Has(prefix + name)) continue;
    if (!file.AllZero(key)) Fail(file, key, prefix, known);
  }
}

}  // namespace lift_slam
