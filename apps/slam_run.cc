#include "apps/slam_run.h"

#include <fmt/format.h>

#include <utility>

#include "apps/online_trajectory_writer.h"
#include "apps/progress_bar.h"
#include "apps/stop_signal.h"
#include "apps/vocabulary_choice.h"
#include "lift_slam/datasets/prefetching_sequence.h"
#include "lift_slam/slam/feature_options.h"
#include "lift_slam/slam/pipeline.h"
#include "lift_slam/util/input_error.h"
#include "lift_slam/util/timer.h"

namespace lift_slam {
namespace {

FrameRefusal RefusalOf(ImageProblem problem) {
  switch (problem) {
    case ImageProblem::kNone:
      return FrameRefusal::kNone;
    case ImageProblem::kUnreadable:
      return FrameRefusal::kImageUnreadable;
    case ImageProblem::kSizeDiffers:
      return FrameRefusal::kImageSizeDiffers;
    case ImageProblem::kTimestampNotIncreasing:
      return FrameRefusal::kTimestampNotIncreasing;
  }
  return FrameRefusal::kImageUnreadable;
}

std::optional<InputFrame> NextInput(Sequence& sequence, const StopSignal& stop, RunLog& log) {
  if (stop.Requested()) return std::nullopt;
  auto frame = sequence.Next();
  if (!frame) return std::nullopt;
  InputFrame input;
  input.frame_index = frame->frame_index;
  input.timestamp_ns = frame->timestamp_ns;
  input.refusal = RefusalOf(frame->problem);
  if (frame->image) input.image = *frame->image;
  if (frame->problem != ImageProblem::kNone) log.Warning(frame->problem_text);
  return input;
}

// Hears of every frame: log, online trajectory, progress.
class RunObserver {
 public:
  RunObserver(const std::filesystem::path& folder, std::optional<std::int64_t> frames_total,
              const SlamSystem& system, RunLog& log)
      : online_(folder / "trajectory_online.tum"), system_(system), log_(log) {
    progress_.frames_total = frames_total;
  }

  void FrameDone(const FrameRecord& frame) {
    if (frame.world_from_cam) {
      online_.Append(
          {frame.frame_index, frame.timestamp_ns, *frame.world_from_cam, PoseState::kOk});
    }
    if (frame.state != state_ || frame.refusal != refusal_) {
      log_.Info(fmt::format("frame {}: {}{}", frame.frame_index, Name(frame.state),
                            frame.refusal == FrameRefusal::kNone
                                ? std::string()
                                : fmt::format(" ({})", Name(frame.refusal))));
      state_ = frame.state;
      refusal_ = frame.refusal;
    }
    if (frame.num_impulses > 0 && !std::exchange(noise_said_, true)) {
      log_.Warning(
          fmt::format("frame {}: salt-and-pepper noise, {} pixels taken out; so in later frames",
                      frame.frame_index, frame.num_impulses));
    }
    LogPlaces(frame.frame_index);
    Update();
    bar_.Update(progress_);
    ++progress_.frames_done;
  }
  void Finish() {
    Update();
    bar_.Finish(progress_);
  }

 private:
  void LogPlaces(std::int64_t frame_index) {
    const auto& events = system_.place_events();
    for (; num_place_events_ < events.size(); ++num_place_events_) {
      const PlaceEvent& event = events[num_place_events_];
      const bool is_accepted = event.rejection == PlaceRejection::kAccepted;
      log_.Info(fmt::format(
          "frame {}: {} with frame {}: {} (score {:.3f}, {} by words, {} inliers, {} seen = {:.2f} "
          "of {:.2f}, mutual {:.2f}, offset {:.2f}, {} confirm{})",
          frame_index, Name(event.kind), event.other_frame_index, Name(event.rejection),
          event.score, event.num_word_matches, event.num_inliers, event.num_projected,
          event.found_ratio, event.own_found_ratio, event.mutual_ratio, event.offset_ratio,
          event.num_confirming,
          is_accepted ? fmt::format(", scale {:.3f}", event.scale) : std::string()));
    }
  }
  void Update() {
    progress_.state = Name(system_.state());
    progress_.keyframes = system_.num_keyframes();
    progress_.map_points = system_.num_points();
  }

  OnlineTrajectoryWriter online_;
  const SlamSystem& system_;
  RunLog& log_;
  std::size_t num_place_events_ = 0;  // logged
  bool noise_said_ = false;
  ProgressBar bar_;
  Progress progress_;
  TrackingState state_ = TrackingState::kInitializing;
  FrameRefusal refusal_ = FrameRefusal::kNone;
};

std::uint64_t ChecksumOf(const VocabularyChoice& places) {
  return places.vocabulary ? places.vocabulary->info().checksum : 0;
}

void LoadMaps(const std::filesystem::path& path, const FramePreparer& preparer,
              const DescriptorKind& kind, const VocabularyChoice& places,
              const SlamOptions& options, SlamSystem& system, RunLog& log) {
  if (!places.vocabulary) {
    throw InputError(
        fmt::format("{}: a map is found again by visual words, expected a vocabulary: {}",
                    path.string(), places.notice));
  }
  if (!options.loop_closing.relocalisation) {
    throw InputError(fmt::format(
        "{}: a map is found again by relocalisation, which slam.loop_closing.relocalisation "
        "switches off",
        path.string()));
  }
  const Timer timer;
  MapFile file = ReadMapFile(path, preparer.view(), kind);
  int keyframes = 0, points = 0;
  for (const StoredMap& stored : file.maps) {
    keyframes += stored.map->num_keyframes();
    points += stored.map->num_points();
  }
  const std::size_t num_maps = file.maps.size();
  const bool has_other_words = file.info.vocabulary_checksum != ChecksumOf(places);
  system.LoadMaps(std::move(file));
  log.Info(fmt::format("{}: {} map(s) with {} keyframes and {} points, loaded in {:.0f} ms{}",
                       path.string(), num_maps, keyframes, points, timer.ElapsedMs(),
                       has_other_words ? " (made with another vocabulary)" : ""));
}

std::shared_ptr<FeatureCache> OpenFeatureCache(const std::filesystem::path& folder) {
  return folder.empty() ? nullptr : std::make_shared<FeatureCache>(folder);
}

void LogCache(const FeatureCache::Statistics& statistics, RunLog& log) {
  log.Info(fmt::format("feature cache: images found {}, made {}", statistics.num_found,
                       statistics.num_made));
  if (!statistics.write_error.empty()) {
    log.Warning("features are no longer kept: " + statistics.write_error);
  }
}

// Why they could not be saved, if so.
std::string SaveMaps(const std::filesystem::path& path, const MapFileInfo& info,
                     const RunRecord& record, SlamSystem& system, RunLog& log) {
  if (record.num_maps == 0) {
    log.Warning(fmt::format("{}: not written, the run made no map", path.string()));
    return {};
  }
  try {
    system.SaveMaps(path, info);
  } catch (const InputError& error) {
    return error.what();
  }
  log.Info(fmt::format("{}: {} map(s) saved, {:.1f} MB", path.string(), record.num_maps,
                       1e-6 * static_cast<double>(std::filesystem::file_size(path))));
  return {};
}

}  // namespace

void MapFiles::Check() const {
  if (localization_only && load.empty()) {
    throw InputError("--localization-only: expected a map to localise in, --load-map FILE");
  }
  if (localization_only && !save.empty()) {
    throw InputError("--save-map: there is nothing to save with --localization-only");
  }
  const std::filesystem::path folder = save.has_parent_path() ? save.parent_path() : ".";
  if (!save.empty() && !std::filesystem::is_directory(folder)) {
    throw InputError(
        fmt::format("{}: no such folder, expected one to save the map in", folder.string()));
  }
  if (std::filesystem::is_directory(save)) {
    throw InputError(fmt::format("--save-map: {} is a folder, expected a file", save.string()));
  }
}

SlamRun RunSlam(std::unique_ptr<Sequence> sequence, const ProgramOptions& options,
                const std::filesystem::path& folder, const RunFiles& files, RunLog& log,
                const std::vector<ImageDistortion>& distortions) {
  const MapFiles& maps = files.maps;
  const SequenceInfo info = sequence->info();
  if (options.mode == RunMode::kThreaded) {
    sequence = std::make_unique<PrefetchingSequence>(std::move(sequence));
  }
  SlamOptions slam = options.slam;
  slam.seed = options.seed;
  slam.localization_only = maps.localization_only;
  const auto cache = OpenFeatureCache(files.feature_cache);
  auto extractor = CreateFeatureExtractor(slam.features, cache);
  if (const std::string notice = extractor->Notice(); !notice.empty()) log.Warning(notice);
  const DescriptorKind kind = extractor->descriptor_kind();
  const VocabularyChoice places = ChooseVocabulary(slam.loop_closing, kind);
  if (!places.notice.empty()) log.Info("loop closing and relocalisation are off: " + places.notice);
  FramePreparer preparer(*info.camera, std::move(extractor), slam.alignment, slam.impulse_noise);
  SlamSystem system(*info.camera, preparer.view(), slam, places.vocabulary);
  if (!maps.load.empty()) LoadMaps(maps.load, preparer, kind, places, slam, system, log);
  const StopSignal stop;
  RunObserver observer(folder, info.num_frames, system, log);
  const Timer timer;
  RunPipeline(options.mode,
              {[&] {
                 auto input = NextInput(*sequence, stop, log);
                 if (input && !distortions.empty()) {
                   input->image =
                       Distort(input->image, distortions, static_cast<std::uint64_t>(options.seed),
                               input->frame_index);
                 }
                 return input;
               },
               [&](const FrameRecord& frame) {
                 observer.FrameDone(frame);
                 return !stop.Requested();
               }},
              preparer, system);
  const bool is_interrupted = stop.Requested();  // not one that comes after the last frame
  observer.Finish();
  SlamRun run{system.Finish(), {}};
  RunRecord& record = run.record;
  if (cache) {
    LogCache(cache->statistics(), log);
    record.num_cached_frames = cache->statistics().num_found;
  }
  record.wall_time_s = timer.ElapsedMs() * 1e-3;
  record.place_recognition_notice = places.notice;
  record.interrupted = is_interrupted;
  if (!maps.save.empty()) {
    run.save_error =
        SaveMaps(maps.save, MakeMapFileInfo(*preparer.view(), kind, ChecksumOf(places)), record,
                 system, log);
  }
  if (record.interrupted) log.Warning(fmt::format("ended early by {}", stop.Name()));
  return run;
}

}  // namespace lift_slam
