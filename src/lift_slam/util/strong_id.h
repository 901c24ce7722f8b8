#pragma once

#include <compare>
#include <cstdint>
#include <functional>

namespace lift_slam {

// An id that cannot be mixed up with an id of another kind, nor with an index.
// Valid ids are dense and count from 0 in order of creation, so order by id is order of creation.
template <class Tag>
struct StrongId {
  std::int32_t value = -1;

  constexpr StrongId() = default;
  constexpr explicit StrongId(std::int32_t v) : value(v) {}
  constexpr bool valid() const { return value >= 0; }
  constexpr std::size_t index() const { return static_cast<std::size_t>(value); }
  friend constexpr auto operator<=>(const StrongId&, const StrongId&) = default;
};

}  // namespace lift_slam

template <class Tag>
struct std::hash<lift_slam::StrongId<Tag>> {
  std::size_t operator()(const lift_slam::StrongId<Tag>& id) const noexcept {
    return std::hash<std::int32_t>()(id.value);
  }
};
