#include "lift_slam/simulation/render_record.h"

#include <fmt/format.h>

#include "lift_slam/util/config_file.h"
#include "lift_slam/util/input_error.h"
#include "lift_slam/util/option_writer.h"

namespace lift_slam {
namespace {

constexpr std::string_view kTitle =
    "All that this sequence was rendered from; 'lift_slam render --config' takes it again";

std::string ValueOf(const std::vector<Setting>& settings, const std::string& path) {
  for (const Setting& setting : settings) {
    if (setting.path == path) return setting.value;
  }
  return "(nothing)";
}

void CheckSame(const std::filesystem::path& file, const std::vector<Setting>& old_settings,
               const std::vector<Setting>& new_settings, const std::vector<Setting>& all) {
  for (const Setting& setting : all) {
    const std::string old_value = ValueOf(old_settings, setting.path);
    const std::string new_value = ValueOf(new_settings, setting.path);
    if (old_value == new_value) continue;
    throw InputError(fmt::format(
        "{}: the sequence there was rendered with {} = {}, now it is {}; choose another output "
        "folder or remove this one",
        file.string(), setting.path, old_value, new_value));
  }
}

}  // namespace

void WriteOrCheckRenderRecord(const std::filesystem::path& path, const OptionRoot& inputs) {
  if (!std::filesystem::exists(path)) {
    WriteConfigFile(path, kTitle, inputs);
    return;
  }
  const std::vector<Setting> old_settings = ReadConfigFile(path);
  const std::vector<Setting> new_settings = ReadConfigText(OptionsToYaml(inputs), "new");
  CheckSame(path, old_settings, new_settings, new_settings);
  CheckSame(path, old_settings, new_settings, old_settings);
}

}  // namespace lift_slam
