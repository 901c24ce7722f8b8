#include "lift_slam/place_recognition/vocabulary_trainer.h"

#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>

#include "lift_slam/place_recognition/clustering.h"
#include "lift_slam/place_recognition/training_state.h"
#include "lift_slam/util/input_error.h"
#include "lift_slam/util/option_range.h"
#include "lift_slam/util/parallel_for.h"
#include "lift_slam/util/sha256.h"

namespace lift_slam {
namespace {

// Nodes with more rows are split one after another by all threads, others side by side.
constexpr std::size_t kSharedRows = 20000;
// Small nodes are taken in batches of about so many rows, between which progress is told.
constexpr std::size_t kBatchRows = 200000;
constexpr std::size_t kChunkRows = 4096;
constexpr std::size_t kMinRowsPerRootChild = 10;

struct RowRange {
  std::size_t begin = 0, end = 0;
  std::size_t size() const { return end - begin; }
};

// The children of one node; no centers when it stays a word.
struct Split {
  Descriptors centers;
  std::vector<std::uint32_t> num_rows;  // of each child
};

std::string Key(const DescriptorFile& file, const VocabularyTrainingOptions& options) {
  return Sha256Hex(fmt::format("2 {} {} {} {} {} {} {} {} {}", file.kind().name, file.num_rows(),
                               file.num_images(), file.source_sha256(), options.branching,
                               options.depth, options.max_iterations,
                               options.max_rows_per_clustering, options.min_rows_to_split) +
                   fmt::format(" {}", options.seed));
}

Descriptors Concatenate(const Descriptors& first, const std::vector<Split>& splits) {
  std::size_t count = first.size();
  for (const Split& split : splits) count += split.centers.size();
  Descriptors all(first.kind(), count);
  std::byte* next = all.mutable_data();
  const auto append = [&](const Descriptors& rows) {
    const std::size_t size = rows.size() * first.kind().BytesPerRow();
    if (size > 0) std::memcpy(next, rows.data(), size);
    next += size;
  };
  append(first);
  for (const Split& split : splits) append(split.centers);
  return all;
}

class Trainer {
 public:
  Trainer(const DescriptorFile& file, const VocabularyTrainingOptions& options,
          const TrainingCallback& callback)
      : file_(file), options_(options), callback_(callback) {}

  std::optional<VocabularyTree> Run(const std::filesystem::path& checkpoint) {
    const std::string key = Key(file_, options_);
    Begin(checkpoint, key);
    while (state_.level < static_cast<std::uint64_t>(options_.depth)) {
      if (!SplitLevel()) return std::nullopt;
      if (!checkpoint.empty()) WriteTrainingState(state_, key, checkpoint);
    }
    return Finish();
  }

 private:
  void Begin(const std::filesystem::path& checkpoint, const std::string& key) {
    if (!checkpoint.empty()) {
      if (auto state = ReadTrainingState(checkpoint, key, file_.kind())) {
        state_ = std::move(*state);
        return;
      }
    }
    state_.order.resize(file_.num_rows());
    std::iota(state_.order.begin(), state_.order.end(), 0U);
    state_.row_begin = {0, static_cast<std::uint32_t>(file_.num_rows())};
    state_.centers = Descriptors(file_.kind(), 1);
  }

  VocabularyTree Finish() {
    next_child_ = static_cast<std::uint32_t>(state_.centers.size());
    for (std::size_t i = 0; i < num_level_nodes(); ++i) CloseNode(i, 0);
    state_.children_begin.push_back(next_child_);
    VocabularyTree tree;
    tree.kind = file_.kind();
    tree.branching = options_.branching;
    tree.depth = options_.depth;
    tree.num_images = static_cast<std::uint32_t>(file_.num_images());
    tree.num_rows = file_.num_rows();
    tree.centers = std::move(state_.centers);
    tree.children_begin = std::move(state_.children_begin);
    tree.idf = std::move(state_.idf);
    return tree;
  }

  std::size_t num_level_nodes() const { return state_.row_begin.size() - 1; }
  RowRange Rows(std::size_t i) const { return {state_.row_begin[i], state_.row_begin[i + 1]}; }

  // Splits all nodes of the level; false when told to stop.
  bool SplitLevel() {
    std::vector<Split> splits(num_level_nodes());
    rows_done_ = state_.level * file_.num_rows();
    for (std::size_t i = 0; i < splits.size(); ++i) {
      if (Rows(i).size() <= kSharedRows) continue;
      splits[i] = SplitNode(i, options_.num_threads);
      if (!Tell(Rows(i).size())) return false;
    }
    if (!SplitSmallNodes(splits)) return false;
    AppendChildren(splits);
    return true;
  }

  bool SplitSmallNodes(std::vector<Split>& splits) {
    std::vector<std::size_t> batch;
    std::size_t rows = 0;
    for (std::size_t i = 0; i < splits.size(); ++i) {
      if (Rows(i).size() <= kSharedRows) {
        batch.push_back(i);
        rows += Rows(i).size();
      }
      if (rows < kBatchRows && i + 1 < splits.size()) continue;
      ParallelFor(batch.size(), options_.num_threads,
                  [&](std::size_t k) { splits[batch[k]] = SplitNode(batch[k], 1); });
      if (!Tell(rows)) return false;
      batch.clear();
      rows = 0;
    }
    return true;
  }

  bool Tell(std::size_t rows) {
    rows_done_ += rows;
    if (!callback_) return true;
    return callback_({static_cast<int>(state_.level), rows_done_,
                      static_cast<std::uint64_t>(options_.depth) * file_.num_rows()});
  }

  // Groups the node's rows by child.
  Split SplitNode(std::size_t i, int num_threads) {
    const RowRange range = Rows(i);
    if (range.size() < static_cast<std::size_t>(options_.min_rows_to_split)) return {};
    const auto limit = static_cast<std::size_t>(options_.max_rows_per_clustering);
    Clustering clustering =
        ClusterDescriptors(Gather(range, std::min(range.size(), limit)),
                           {options_.branching, options_.max_iterations, num_threads}, NodeSeed(i));
    if (clustering.centers.size() < 2) return {};
    if (range.size() > limit) {
      clustering.assignment = AssignAll(range, clustering.centers, num_threads);
    }
    Split split{std::move(clustering.centers), {}};
    split.num_rows = GroupRows(range, clustering.assignment, split.centers.size());
    return split;
  }

  std::uint64_t NodeSeed(std::size_t i) const {
    const std::size_t node = state_.idf.size() + i;
    return 0x9e3779b97f4a7c15 * (node + 1) + static_cast<std::uint64_t>(options_.seed);
  }

  // `count` of the rows, evenly spread.
  Descriptors Gather(const RowRange& range, std::size_t count) const {
    Descriptors rows(file_.kind(), count);
    for (std::size_t i = 0; i < count; ++i) {
      const DescriptorView row = file_.row(state_.order[range.begin + i * range.size() / count]);
      std::memcpy(rows.mutable_row(i).data(), row.data(), row.size());
    }
    return rows;
  }

  std::vector<std::uint8_t> AssignAll(const RowRange& range, const Descriptors& centers,
                                      int num_threads) const {
    std::vector<std::uint8_t> assignment(range.size());
    ParallelFor((range.size() + kChunkRows - 1) / kChunkRows, num_threads, [&](std::size_t chunk) {
      const std::size_t end = std::min(range.size(), (chunk + 1) * kChunkRows);
      for (std::size_t i = chunk * kChunkRows; i < end; ++i) {
        assignment[i] = NearestCenter(centers, file_.row(state_.order[range.begin + i]));
      }
    });
    return assignment;
  }

  // Keeps the order within a child, so rows of an image stay together. Returns the children's
  // sizes.
  std::vector<std::uint32_t> GroupRows(const RowRange& range,
                                       const std::vector<std::uint8_t>& assignment,
                                       std::size_t num_children) {
    std::vector<std::uint32_t> sizes(num_children);
    for (const std::uint8_t child : assignment) ++sizes[child];
    std::vector<std::size_t> next(num_children);
    for (std::size_t child = 1; child < num_children; ++child) {
      next[child] = next[child - 1] + sizes[child - 1];
    }
    std::vector<std::uint32_t> grouped(range.size());
    for (std::size_t i = 0; i < range.size(); ++i) {
      grouped[next[assignment[i]]++] = state_.order[range.begin + i];
    }
    std::copy(grouped.begin(), grouped.end(),
              state_.order.begin() + static_cast<std::ptrdiff_t>(range.begin));
    return sizes;
  }

  // Enters the level's node i, which has so many children.
  void CloseNode(std::size_t i, std::size_t num_children) {
    state_.children_begin.push_back(next_child_);
    next_child_ += static_cast<std::uint32_t>(num_children);
    state_.idf.push_back(num_children > 0 ? 0.0F : InverseDocumentFrequency(Rows(i)));
  }

  float InverseDocumentFrequency(const RowRange& range) const {
    std::size_t images = 0, last = std::numeric_limits<std::size_t>::max();
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const std::size_t image = file_.image_of_row(state_.order[i]);
      images += image != last;
      last = image;
    }
    return std::log(static_cast<float>(file_.num_images()) / static_cast<float>(images));
  }

  // The children become the level. Rows of words leave the order.
  void AppendChildren(const std::vector<Split>& splits) {
    next_child_ = static_cast<std::uint32_t>(state_.centers.size());
    std::vector<std::uint32_t> order, row_begin = {0};
    order.reserve(state_.order.size());
    for (std::size_t i = 0; i < splits.size(); ++i) {
      CloseNode(i, splits[i].num_rows.size());
      for (const std::uint32_t rows : splits[i].num_rows)
        row_begin.push_back(row_begin.back() + rows);
      if (splits[i].num_rows.empty()) continue;
      const auto begin = state_.order.begin();
      order.insert(order.end(), begin + static_cast<std::ptrdiff_t>(Rows(i).begin),
                   begin + static_cast<std::ptrdiff_t>(Rows(i).end));
    }
    state_.centers = Concatenate(state_.centers, splits);
    state_.order = std::move(order);
    state_.row_begin = std::move(row_begin);
    ++state_.level;
  }

  const DescriptorFile& file_;
  const VocabularyTrainingOptions& options_;
  const TrainingCallback& callback_;
  TrainingState state_;
  std::uint32_t next_child_ = 0;  // of the node that is entered next
  std::uint64_t rows_done_ = 0;
};

void CheckEnough(const DescriptorFile& file, const VocabularyTrainingOptions& options) {
  const std::size_t needed = kMinRowsPerRootChild * static_cast<std::size_t>(options.branching);
  if (file.num_rows() < needed || file.num_images() < 2) {
    throw InputError(
        fmt::format("too few descriptors for a vocabulary: {} from {} images, expected at least "
                    "{} from 2 or more",
                    file.num_rows(), file.num_images(), needed));
  }
  if (file.num_rows() > std::numeric_limits<std::uint32_t>::max() / 2) {
    throw InputError(fmt::format("too many descriptors for a vocabulary: {}", file.num_rows()));
  }
}

}  // namespace

void VocabularyTrainingOptions::Visit(OptionVisitor& visitor) {
  visitor.Field("branching", branching, "children of a node, k");
  visitor.Field("depth", depth, "levels below the root, L");
  visitor.Field("max_iterations", max_iterations, "of k-means");
  visitor.Field("max_rows_per_clustering", max_rows_per_clustering,
                "descriptors of a node that k-means sees");
  visitor.Field("min_rows_to_split", min_rows_to_split, "a node with fewer stays a word");
  visitor.Field("seed", seed, "of the first centers");
  visitor.Field("num_threads", num_threads, "threads; the result does not depend on them");
}

void VocabularyTrainingOptions::Check() const {
  CheckOptionRange("branching", branching, 2, 64);
  CheckOptionRange("depth", depth, 1, 16);
  CheckOptionRange("max_iterations", max_iterations, 1, 1000);
  CheckOptionRange("max_rows_per_clustering", max_rows_per_clustering, 1000, 100'000'000);
  CheckOptionRange("min_rows_to_split", min_rows_to_split, 2, 1'000'000);
  CheckOptionRange("num_threads", num_threads, 1, 256);
}

std::optional<VocabularyTree> TrainVocabulary(const DescriptorFile& file,
                                              const VocabularyTrainingOptions& options,
                                              const std::filesystem::path& checkpoint,
                                              const TrainingCallback& callback) {
  options.Check();
  CheckEnough(file, options);
  return Trainer(file, options, callback).Run(checkpoint);
}

}  // namespace lift_slam
