#include "lift_slam/util/checksum64.h"

#include <array>
#include <bit>
#include <cstring>

namespace lift_slam {
namespace {

// Odd numbers with even spreads of bits: multiplying by them loses nothing.
constexpr std::uint64_t kFirst = 0x9e3779b97f4a7c15, kSecond = 0xd6e8feb86659fd93;
constexpr std::size_t kLanes = 4, kBlockBytes = kLanes * sizeof(std::uint64_t);

// For each hash a one-to-one function of the word, and the other way round.
std::uint64_t Mix(std::uint64_t hash, std::uint64_t word) {
  return std::rotl(hash ^ (word * kFirst), 29) * kSecond;
}

// Lanes that do not wait for one another.
void AddBlock(const std::byte* block, std::array<std::uint64_t, kLanes>& lanes) {
  std::array<std::uint64_t, kLanes> words;
  std::memcpy(words.data(), block, kBlockBytes);
  for (std::size_t i = 0; i < kLanes; ++i) lanes[i] = Mix(lanes[i], words[i]);
}

}  // namespace

std::uint64_t Checksum64(std::span<const std::byte> bytes, std::uint64_t seed) {
  std::array<std::uint64_t, kLanes> lanes = {seed, seed + 1, seed + 2, seed + 3};
  std::size_t at = 0;
  for (; at + kBlockBytes <= bytes.size(); at += kBlockBytes) AddBlock(bytes.data() + at, lanes);
  if (at < bytes.size()) {
    std::array<std::byte, kBlockBytes> rest{};
    std::memcpy(rest.data(), bytes.data() + at, bytes.size() - at);
    AddBlock(rest.data(), lanes);
  }
  std::uint64_t hash = bytes.size();
  for (const std::uint64_t lane : lanes) hash = Mix(hash, lane);
  return hash ^ (hash >> 32);
}

}  // namespace lift_slam
