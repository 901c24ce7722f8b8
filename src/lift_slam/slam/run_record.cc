#include "lift_slam/slam/run_record.h"

namespace lift_slam {

std::string_view Name(PlaceEventKind kind) {
  switch (kind) {
    case PlaceEventKind::kLoop:
      return "loop";
    case PlaceEventKind::kMerge:
      return "merge";
    case PlaceEventKind::kRelocalisation:
      return "relocalisation";
  }
  return "unknown";
}

}  // namespace lift_slam
