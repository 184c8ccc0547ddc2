#include "kernel/run/checkpoint/checkpoint.h"

#include <span>
#include <system_error>
#include <utility>

#include "kernel/automaton/state/digest.h"
#include "kernel/engine/cpu/workers.h"
#include "kernel/run/checkpoint/blocks.h"
#include "kernel/run/checkpoint/columns.h"
#include "kernel/run/checkpoint/head_json.h"

namespace voxmelt::checkpoint {
namespace {

constexpr std::uint64_t kLargestHead = std::uint64_t{64} << 20;

Head take_head(BlockReader& reader, const std::filesystem::path& file) {
  const Bytes bytes = reader.next({"head", 0, 0}, kLargestHead);
  return head_of(std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()), file);
}

}  // namespace

FileState state_of(const std::filesystem::path& file, std::string name) {
  std::error_code error;
  const std::uint64_t bytes = std::filesystem::file_size(file, error);
  if (error) fail(file, "cannot be read: " + error.message());
  return {std::move(name), bytes, checksum_of_file(file)};
}

void write(const std::filesystem::path& place, Head head, const state::Volume& volume,
           const state::Field<std::uint16_t>* irradiance, int threads) {
  head.grid = volume.grid;
  head.digest = state::digest(volume);
  head.radiates = irradiance != nullptr;
  cpu::Workers workers(threads);
  BlockWriter writer(place);
  const std::string json = json_of(head);
  writer.put({"head", 0, 0}, packed(std::as_bytes(std::span(json))));
  if (!head.scene.terrain.empty())
    writer.put({"terrain", 0, 0}, packed(std::as_bytes(std::span(head.scene.terrain))));
  put_volume(writer, workers, volume);
  if (irradiance != nullptr) put_field(writer, workers, "light", *irradiance, volume.grid);
  writer.finish();
}

Checkpoint read(const std::filesystem::path& file) {
  (void)BlockReader::list(file);  // checks that every block is whole, before memory is taken for any
  BlockReader reader(file);
  Checkpoint result;
  Head& head = result.head;
  head = take_head(reader, file);
  if (!head.scene.terrain.empty())
    (void)reader.next_is_empty({"terrain", 0, 0}, std::as_writable_bytes(std::span(head.scene.terrain)));
  result.volume = take_volume(reader, head.grid);
  if (head.radiates) head.run.irradiance = take_field(reader, "light", head.grid);
  reader.finish();
  if (state::digest(result.volume) != head.digest) fail(file, "its cells do not have the digest of its head");
  return result;
}

Head read_head(const std::filesystem::path& file) {
  BlockReader reader(file);
  return take_head(reader, file);
}

}  // namespace voxmelt::checkpoint
