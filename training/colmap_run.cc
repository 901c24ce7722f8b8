#include "training/colmap_run.h"

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>

#include "lift_slam/datasets/sequence.h"
#include "lift_slam/util/file.h"
#include "lift_slam/util/input_error.h"
#include "lift_slam/util/option_range.h"
#include "lift_slam/util/option_root.h"
#include "lift_slam/util/option_writer.h"
#include "training/colmap_reader.h"
#include "training/process.h"

namespace lift_slam::training {
namespace {

// COLMAP's name of the camera model and its parameters; it counts pixels from the image's corner.
std::pair<std::string, std::string> CameraArguments(const Camera& camera) {
  const PinholeIntrinsics& p = camera.pinhole;
  const std::string pinhole = fmt::format("{},{},{},{}", p.fx, p.fy, p.cx + 0.5, p.cy + 0.5);
  if (const auto* d = std::get_if<RadialTangential>(&camera.distortion)) {
    if (d->k3 != 0.0) {
      return {"FULL_OPENCV",
              fmt::format("{},{},{},{},{},{},0,0,0", pinhole, d->k1, d->k2, d->p1, d->p2, d->k3)};
    }
    return {"OPENCV", fmt::format("{},{},{},{},{}", pinhole, d->k1, d->k2, d->p1, d->p2)};
  }
  if (const auto* d = std::get_if<KannalaBrandt>(&camera.distortion)) {
    return {"OPENCV_FISHEYE", fmt::format("{},{},{},{},{}", pinhole, d->k1, d->k2, d->k3, d->k4)};
  }
  if (const auto* d = std::get_if<FieldOfView>(&camera.distortion)) {
    return {"FOV", fmt::format("{},{}", pinhole, d->omega)};
  }
  return {"PINHOLE", pinhole};
}

// What `work` is a reconstruction of: its file "source".
std::string DescribeSource(const std::string& sequence, ReconstructionOptions options) {
  std::filesystem::path path = std::filesystem::weakly_canonical(sequence);
  if (!path.has_filename()) path = path.parent_path();  // a slash behind it
  return path.string() + "\n" + OptionsToYaml(MakeOptionRoot(options));
}

void CheckSource(const ColmapPaths& paths, const std::filesystem::path& work,
                 const std::string& source) {
  const std::filesystem::path file = work / "source";
  const bool is_same = std::filesystem::exists(file) ? ReadText(file) == source
                                                     : !std::filesystem::exists(paths.images) &&
                                                           !std::filesystem::exists(paths.database);
  if (is_same) return;
  throw InputError(fmt::format(
      "{}: holds the reconstruction of another sequence, or one with other options (its "
      "file 'source' tells); remove it or choose another folder",
      work.string()));
}

// Appears whole or not at all: what is there is used again.
void WriteImage(const GrayImage& image, const std::filesystem::path& path) {
  std::vector<std::uint8_t> bytes;
  if (!cv::imencode(".png", image.mat(), bytes)) {
    throw InputError(fmt::format("{}: cannot be encoded", path.string()));
  }
  WriteFileAtomically(path, [&](std::ostream& stream) {
    stream.write(reinterpret_cast<const char*>(bytes.data()), std::ssize(bytes));
  });
}

Camera ExportImages(const std::string& source, const std::filesystem::path& work,
                    const ReconstructionOptions& options) {
  SequenceOptions sequence_options;
  sequence_options.step = options.step;
  const auto sequence = OpenSequence(source, sequence_options);
  const std::filesystem::path folder = work / "images";
  CreateFolder(work);
  WriteTextAtomically(work / "source", DescribeSource(source, options));
  CreateFolder(folder);
  int written = 0;
  while (auto frame = sequence->Next()) {
    if (!frame->image) continue;
    const std::filesystem::path path = folder / fmt::format("{:06}.png", frame->frame_index);
    if (!std::filesystem::exists(path)) WriteImage(*frame->image, path);
    if (++written == options.max_frames) break;
  }
  return *sequence->info().camera;
}

std::filesystem::path LargestModel(const std::filesystem::path& sparse) {
  std::filesystem::path best;
  std::size_t most = 0;
  for (const auto& entry : std::filesystem::directory_iterator(sparse)) {
    if (!entry.is_directory()) continue;
    const std::size_t images = ReadColmapImages(entry.path()).size();
    if (images > most || (images == most && entry.path() < best)) {
      most = images;
      best = entry.path();
    }
  }
  if (most == 0) {
    throw InputError(
        fmt::format("{}: COLMAP found no model: the images overlap too little, or the "
                    "camera hardly moved",
                    sparse.string()));
  }
  return best;
}

}  // namespace

void ReconstructionOptions::Visit(OptionVisitor& visitor) {
  visitor.Field("step", step, "every so many frames of the sequence");
  visitor.Field("max_frames", max_frames, "0: all");
  visitor.Field("max_features", max_features, "SIFT keypoints of an image");
  visitor.Field("overlap", overlap, "following images that an image is matched with");
}

void ReconstructionOptions::Check() const {
  CheckOptionRange("reconstruction.step", step, 1, 100000);
  CheckOptionRange("reconstruction.max_frames", max_frames, 0, 1e9);
  CheckOptionRange("reconstruction.max_features", max_features, 10, 1e6);
  CheckOptionRange("reconstruction.overlap", overlap, 1, 1000);
}

ColmapPaths ReconstructSequence(const std::string& sequence, const std::filesystem::path& work,
                                const ReconstructionOptions& options) {
  options.Check();
  const ColmapPaths paths{work / "sparse", work / "images", work / "database.db"};
  CheckSource(paths, work, DescribeSource(sequence, options));
  const Camera camera = ExportImages(sequence, work, options);
  const auto [model, parameters] = CameraArguments(camera);
  const std::filesystem::path done = work / "reconstructed";
  if (!std::filesystem::exists(done)) {
    CreateFolder(paths.model);
    std::filesystem::remove(paths.database);
    setenv("QT_QPA_PLATFORM", "offscreen", 1);
    const std::string database = paths.database.string(), log = (work / "colmap.log").string();
    RunProcess(
        {"colmap", "feature_extractor", "--database_path", database, "--image_path",
         paths.images.string(), "--ImageReader.single_camera", "1", "--ImageReader.camera_model",
         model, "--ImageReader.camera_params", parameters, "--SiftExtraction.use_gpu", "0",
         "--SiftExtraction.max_num_features", std::to_string(options.max_features)},
        log);
    RunProcess(
        {"colmap", "sequential_matcher", "--database_path", database, "--SiftMatching.use_gpu", "0",
         "--SequentialMatching.overlap", std::to_string(options.overlap)},
        log);
    RunProcess({"colmap", "mapper", "--database_path", database, "--image_path",
                paths.images.string(), "--output_path", paths.model.string(),
                "--Mapper.ba_refine_focal_length", "0", "--Mapper.ba_refine_extra_params", "0"},
               log);
    WriteTextAtomically(done, sequence + "\n");
  }
  return {LargestModel(paths.model), paths.images, paths.database};
}

}  // namespace lift_slam::training
