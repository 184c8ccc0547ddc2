// Writes what voxmelt tells of a state (kernel/vdb/stream.h). It holds which cells of a grid are active, and
// the numbers of one brick.
#pragma once

#include <openvdb/openvdb.h>
#include <openvdb/tools/Prune.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <string>

#include "app/vdb/archives.h"
#include "app/vdb/bounds.h"
#include "kernel/vdb/stream.h"

namespace voxmelt::vdb {

using Leaf = openvdb::FloatTree::LeafNodeType;

inline std::uint64_t identity_of(std::uint64_t before, const void* bytes, std::size_t count) {
  for (std::size_t i = 0; i + 8 <= count; i += 8) {
    std::uint64_t word = 0;
    std::memcpy(&word, static_cast<const char*>(bytes) + i, 8);
    before = (before ^ word) * 0x100000001B3ULL;
    before ^= before >> 29;
  }
  return before;
}

inline openvdb::FloatGrid::Ptr grid_of(const GridRecord& record) {
  auto grid = openvdb::FloatGrid::create(0.0F);
  grid->setName(record.name.data());
  grid->setGridClass(record.is_fog != 0 ? openvdb::GRID_FOG_VOLUME : openvdb::GRID_UNKNOWN);
  const auto transform = openvdb::math::Transform::createLinearTransform(1.0);
  transform->postTranslate(openvdb::Vec3d(0.5));  // a voxel lies around its middle, and cell 0 from 0 to 1
  grid->setTransform(transform);
  return grid;
}

class Writer {
 public:
  Writer(const std::string& place, std::int32_t step, std::int32_t grids)
      : file_(place), identity_(static_cast<std::uint64_t>(step) + 0xCBF29CE484222325ULL) {
    openvdb::MetaMap metadata;
    metadata.insertMeta("creator", openvdb::StringMetadata("voxmelt"));
    metadata.insertMeta("step", openvdb::Int32Metadata(step));
    file_.begin(metadata, grids);
  }

  // Takes records until the last one.
  void write() {
    for (;;) {
      Record kind{};
      vdb::take(kind);
      if (kind == Record::grid) {
        complete();
        begin(taken<GridRecord>());
      } else if (kind == Record::brick && grid_ && !is_open_) {
        add(taken<BrickRecord>());
      } else if (kind == Record::tile && grid_ && !is_open_) {
        const auto tile = taken<TileRecord>();
        grid_->tree().addTile(1, place_of(tile), static_cast<float>(tile.number) / unit_, true);
      } else if (kind == Record::numbers && grid_) {
        open();
        add(taken<NumbersRecord>());
      } else if (kind == Record::end) {
        complete();
        return file_.end(identity_);
      } else {
        throw std::runtime_error("the input is no record");
      }
    }
  }

 private:
  template <class Bytes>
  Bytes taken() {
    Bytes record;
    vdb::take(record);
    identity_ = identity_of(identity_, &record, sizeof record);
    return record;
  }
  template <class Bytes>
  static openvdb::Coord place_of(const Bytes& record) {
    return {record.at[0], record.at[1], record.at[2]};
  }

  void begin(const GridRecord& record) {
    grid_ = grid_of(record);
    unit_ = static_cast<float>(record.unit);
  }

  // The leaf has no room for numbers.
  void add(const BrickRecord& brick) {
    auto leaf = std::make_unique<Leaf>(openvdb::PartialCreate(), place_of(brick), 0.0F);
    for (openvdb::Index i = 0; i < kCells; ++i)
      if ((brick.active[i / 64] >> (i % 64) & 1) != 0) leaf->setValueOn(i);
    grid_->tree().addLeaf(leaf.release());
  }

  void open() {
    if (is_open_) return;
    openvdb::tools::pruneTiles(grid_->tree(), 0.0F, false);  // equal tiles become larger ones
    file_.open(*grid_);
    next_ = grid_->constTree().cbeginLeaf();
    is_open_ = true;
  }

  void add(const NumbersRecord& record) {
    if (!next_ || next_->origin() != place_of(record)) throw std::runtime_error("numbers of another brick");
    numbers_.setOrigin(next_->origin());
    numbers_.setValueMask(next_->valueMask());
    for (openvdb::Index i = 0; i < kCells; ++i)
      numbers_.setValueOnly(i, static_cast<float>(record.numbers[i]) / unit_);
    file_.add(numbers_);
    ++next_;
  }

  void complete() {
    if (!grid_) return;
    open();
    if (next_) throw std::runtime_error("a brick has no numbers");
    file_.close();
    next_ = {};
    grid_.reset();
    is_open_ = false;
  }

  OneByOne file_;
  std::uint64_t identity_;
  openvdb::FloatGrid::Ptr grid_;
  float unit_ = 1;
  bool is_open_ = false;                  // all that is active is written, and numbers follow
  openvdb::FloatTree::LeafCIter next_{};  // whose numbers come next
  Leaf numbers_{openvdb::Coord(0, 0, 0), 0.0F};
};

}  // namespace voxmelt::vdb
