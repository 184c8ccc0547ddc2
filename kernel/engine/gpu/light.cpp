// The irradiance on a device: it comes from the host, or the device finds it in its own masks.
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "kernel/automaton/rule/source.h"
#include "kernel/engine/gpu/constants.h"
#include "kernel/engine/gpu/stepper.h"
#include "kernel/engine/gpu/transfer.h"

namespace voxmelt::gpu {

static_assert(rule::kSourceKinds.size() == 4, "a kind whose rays program/light.cl does not know");

// A program has the rays of these kinds alone, so sources that came later may be of others.
bool Stepper::follows_rays(const rule::Heat& heat) const { return (source_kinds(heat) & ~kinds_) == 0; }

// The state is that of the step's begin, so the lists are made for it first.
void Stepper::find_irradiance(std::uint32_t step) {
  const std::size_t cells = static_cast<std::size_t>(shape_.cells);
  if (!irradiance_) irradiance_ = allocate(2 * cells);
  if (!cubes_) {
    constexpr std::size_t kBlock = 16, kBrickCubes = 8;  // as in program/walk.cl
    const auto blocks = [](int side) { return (static_cast<std::size_t>(side) + kBlock - 1) / kBlock; };
    cubes_ = allocate(sizeof(std::uint64_t) * kBrickCubes * shape_.bricks.cells());
    blocks_ = allocate(sizeof(std::uint64_t) * blocks(shape_.grid.x) * blocks(shape_.grid.y) *
                       blocks(shape_.grid.z));
  }
  own_light_ = true;
  device_->clear(*irradiance_, 2 * cells);
  list_bricks();
  device_->run(Kernel::find_cubes, groups_, {constants_.get(), flags_.get(), cubes_.get()});
  device_->run(Kernel::find_blocks, groups_, {constants_.get(), cubes_.get(), blocks_.get()});
  for (const rule::HeatSource& path : parameters_.heat.sources) {
    const rule::SourceKey source = rule::source_at(path, step);
    if (source.power > 0) add_light(source, path.kind);
  }
  device_->run(Kernel::share_light, groups_,
               {constants_.get(), amount_.now.get(), irradiance_.get(), full_.get(), counts_.get(),
                moments_.get(), next_moment()});
}

void Stepper::add_light(const rule::SourceKey& source, rule::SourceKind kind) {
  const auto number = [](auto wide) { return static_cast<std::int32_t>(wide); };
  device_->run(Kernel::add_light, groups_,
               {constants_.get(), tables_.get(), flags_.get(), cubes_.get(), blocks_.get(), irradiance_.get(),
                books_.get(), full_.get(), counts_.get(), number(rule::index_of(kind)), number(source.at.x),
                number(source.at.y), number(source.at.z), number(source.radius), number(source.direction.x),
                number(source.direction.y), number(source.direction.z), number(source.power),
                number(source.power >> 32)});
}

void Stepper::download_irradiance(step::Irradiance& irradiance) {
  auto& numbers = in_flight(std::vector<std::uint16_t>(static_cast<std::size_t>(shape_.cells)));
  device_->read(*irradiance_, numbers.data(), 2 * numbers.size());
  unpack(numbers, shape_, irradiance);
  in_flight_.reset();
}

step::RayCounts Stepper::count_rays() {
  if (own_light_) collect_books();
  return ray_counts_;
}

// Sends the words of 64 cells that are new, or all of it if nobody says which. Tells if it has sent any.
bool Stepper::upload_irradiance(std::uint32_t step, const step::Irradiance* irradiance) {
  if (irradiance == nullptr) return false;
  if (std::exchange(own_light_, false)) knows_light_ = false;
  if (knows_light_ && !parameters_.heat.is_visibility_step(step)) return false;
  const std::optional<state::ChangedRows> told = std::exchange(new_light_, {});
  if (!knows_light_ || !told) {
    const auto& numbers = in_flight(packed(*irradiance, shape_));
    if (!irradiance_) irradiance_ = allocate(2 * numbers.size());
    device_->write(*irradiance_, numbers.data(), 2 * numbers.size());
    in_flight_.reset();
    knows_light_ = true;
    return true;
  }
  const PackedWords& words = in_flight(packed_words(*irradiance, *told, shape_));
  if (words.places.empty()) return false;
  const std::size_t count = words.places.size();
  if (count > light_room_) {
    light_room_ = 2 * count;
    light_places_ = device_->allocate(4 * light_room_);
    light_words_ = device_->allocate(2 * kWordCells * light_room_);
  }
  device_->write(*light_places_, words.places.data(), 4 * count);
  device_->write(*light_words_, words.numbers.data(), 2 * words.numbers.size());
  device_->run(Kernel::put_light, groups_,
               {constants_.get(), light_places_.get(), light_words_.get(), irradiance_.get(),
                static_cast<std::int32_t>(count)});
  return true;
}

}  // namespace voxmelt::gpu
