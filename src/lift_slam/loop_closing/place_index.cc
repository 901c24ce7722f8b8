#include "lift_slam/loop_closing/place_index.h"

#include "lift_slam/util/check.h"

namespace lift_slam {

ImageWords PlaceIndex::WordsOf(const FrameFeatures& features) const {
  return vocabulary_->Transform(features.descriptors());
}

void PlaceIndex::Add(const KeyFrame& keyframe) {
  ImageWords words = WordsOf(*keyframe.features);
  database_.Add(keyframe.id.value, std::move(words.bag));
  direct_.emplace(keyframe.id, std::move(words.direct));
}

void PlaceIndex::ForgetErased(const Map& map) {
  std::erase_if(direct_, [&](const auto& entry) {
    if (map.FindKeyFrame(entry.first) != nullptr) return false;
    database_.Remove(entry.first.value);
    return true;
  });
}

void PlaceIndex::Absorb(const PlaceIndex& other, int offset) {
  for (const auto& [keyframe, direct] : other.direct_) {
    database_.Add(keyframe.value + offset, other.Bag(keyframe));
    direct_.emplace(KeyFrameId(keyframe.value + offset), direct);
  }
}

const BagOfWords& PlaceIndex::Bag(KeyFrameId keyframe) const {
  const BagOfWords* bag = database_.Find(keyframe.value);
  LIFT_SLAM_CHECK(bag != nullptr, "keyframe {} is not in the index", keyframe.value);
  return *bag;
}

CovisibleKeyframes CovisibleIn(const Map& map, int min_shared_points) {
  return [&map, min_shared_points](int keyframe) {
    std::vector<int> ids;
    for (const auto& neighbor :
         map.covisibility().Neighbors(KeyFrameId(keyframe), min_shared_points)) {
      ids.push_back(neighbor.keyframe.value);
    }
    return ids;
  };
}

}  // namespace lift_slam
