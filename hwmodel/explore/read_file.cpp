#include "hwmodel/explore/read_file.h"

#include <algorithm>
#include <memory>
#include <optional>

#include "kernel/scene/text/compose.h"
#include "kernel/scene/text/error.h"

namespace voxmelt::hwmodel::explore {
namespace {

std::string names_of(const std::vector<NamedText>& files) {
  std::string names;
  for (const NamedText& file : files) names += (names.empty() ? "" : ", ") + file.name;
  return names;
}

}  // namespace

scene::Value read_file(const std::vector<NamedText>& files, const std::string& folder,
                       const std::string& name, const std::string& place, const std::string& what) {
  if (name.ends_with(".toml")) return scene::parse_file(name);
  const auto at =
      std::find_if(files.begin(), files.end(), [&](const auto& file) { return file.name == name; });
  if (at == files.end())
    throw scene::InputError(place + ": error: no " + what + " \"" + name + "\"; there are " +
                            names_of(files) + ", or a file that ends in .toml");
  return scene::parse_text(at->text, std::make_shared<const scene::Origin>(scene::Origin{
                                         "hwmodel/explore/" + folder + "/" + name + ".toml", {}, false}));
}

Given override_file(scene::Value& document, const std::vector<std::string>& overrides) {
  Given given;
  for (const std::string& assignment : overrides) {
    scene::apply_override(document, assignment);
    given.insert(assignment.substr(0, assignment.find('=')));
  }
  return given;
}

scene::Reader table_of(scene::Reader& from, const std::string& key) {
  std::optional<scene::Reader> table = from.table(key);
  if (!table) from.fail(key, ": the file has no such table");
  return *table;
}

}  // namespace voxmelt::hwmodel::explore
