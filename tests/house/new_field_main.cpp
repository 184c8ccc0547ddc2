// The program `new_field_main SCENE OUT` does what new_field_test.py asks of a state with a field more,
// `mark`. It reads a scene whose start.fields have marks, and writes npy, VTI and a checkpoint. It ends with
// 1 and a line if marks are lost.
#include <cstdio>
#include <filesystem>

#include "kernel/automaton/state/difference.h"
#include "kernel/automaton/state/digest.h"
#include "kernel/automaton/state/part.h"
#include "kernel/run/checkpoint/checkpoint.h"
#include "kernel/run/io/export.h"
#include "kernel/scene/scene.h"

using namespace voxmelt;

namespace {

int failures = 0;
void expect(bool holds, const char* what) {
  if (holds) return;
  std::puts(what);
  ++failures;
}

state::Volume back_from_checkpoint(const state::Volume& volume, const std::filesystem::path& file) {
  checkpoint::Head head;
  head.scene.settings = "a = 1\n";
  checkpoint::write(file, head, volume, nullptr, 2);
  return checkpoint::read(file).volume;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const std::filesystem::path out(argv[2]);
  const state::Volume volume = scene::load(argv[1], {}).initial;
  for (const io::Format& format : io::formats())
    if (format.missing == nullptr) format.write(volume, out, {});
  expect(!volume.mark.empty(), "start.fields: no marks");

  expect(back_from_checkpoint(volume, out / "marked.vxc") == volume, "the checkpoint has other cells");

  state::Volume other = volume;
  other.mark[other.at(1, 2, 3)] ^= 16;
  expect(!(other == volume), "a mark more or less, and the volumes are equal");
  expect(state::digest(other) != state::digest(volume), "a mark more or less, and the digests are equal");
  const auto difference = state::first_difference(volume, other);
  expect(difference && difference->field == "mark" && difference->z == 3, "the difference has no name");

  const state::Volume part = state::part_of(volume, {{1, 2, 3}, {2, 2, 2}});
  expect(part.mark[part.at(0, 0, 0)] == volume.mark[volume.at(1, 2, 3)], "a part has other marks");
  state::clear(other, {{0, 0, 0}, {volume.grid.x, volume.grid.y, volume.grid.z}});
  expect(state::digest(other) == 0, "marks are not cleared");

  // A volume without the field has no memory, file or block for it.
  const state::Volume plain(volume.grid);
  expect(plain.mark.empty(), "every volume has marks");
  expect(back_from_checkpoint(plain, out / "plain.vxc").mark.empty(), "the checkpoint has invented marks");
  std::filesystem::create_directories(out / "plain");
  for (const io::Format& format : io::formats())
    if (format.missing == nullptr) format.write(plain, out / "plain", {});
  return failures == 0 ? 0 : 1;
}
