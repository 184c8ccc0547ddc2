// Files of OpenVDB, where its own classes do not suffice.
#pragma once

#include <openvdb/io/Archive.h>
#include <openvdb/io/GridDescriptor.h>
#include <openvdb/openvdb.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <ios>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "app/vdb/bounds.h"

namespace voxmelt::vdb {

// Writes grids one after another, and of a grid leaves, where OpenVDB's own files want all of them in memory.
// It lacks their table with which others would load parts of a grid later.
class OneByOne : public openvdb::io::Archive {
 public:
  explicit OneByOne(const std::string& place) {
    stream_.exceptions(std::ios::badbit | std::ios::failbit);
    stream_.open(place, std::ios::binary | std::ios::trunc);
  }
  void begin(const openvdb::MetaMap& metadata, std::int32_t grids) {
    writeHeader(stream_, true);
    metadata.writeMeta(stream_);
    stream_.write(reinterpret_cast<const char*>(&grids), sizeof grids);
  }
  // Writes all of a grid but the numbers of its leaves. These follow in the order of its tree, and then
  // close().
  void open(openvdb::FloatGrid& grid) {
    descriptor_ = openvdb::io::GridDescriptor(grid.getName(), grid.type());
    descriptor_.writeHeader(stream_);
    places_ = stream_.tellp();
    descriptor_.writeStreamPos(stream_);
    descriptor_.setGridPos(stream_.tellp());
    setGridCompression(stream_, grid);
    grid.addStatsMetadata();
    const auto numbers = static_cast<openvdb::Int64>(grid.constTree().leafCount()) *
                         openvdb::FloatTree::LeafNodeType::SIZE * openvdb::Int64{sizeof(float)};
    grid.insertMeta(openvdb::GridBase::META_FILE_MEM_BYTES,
                    openvdb::Int64Metadata(static_cast<openvdb::Int64>(grid.memUsage()) + numbers));
    grid.writeMeta(stream_);
    grid.writeTransform(stream_);
    grid.writeTopology(stream_);
    descriptor_.setBlockPos(stream_.tellp());
  }
  void add(const openvdb::FloatTree::LeafNodeType& leaf) { leaf.writeBuffers(stream_); }
  void close() {
    descriptor_.setEndPos(stream_.tellp());
    stream_.seekp(places_);
    descriptor_.writeStreamPos(stream_);
    stream_.seekp(descriptor_.getEndPos());
  }
  // OpenVDB gives each file an identifier at random. Equal states have equal files, so it goes with the
  // state.
  void end(std::uint64_t identity) {
    constexpr int place_of_identifier = 8 + 4 + 4 + 4 + 1;  // after magic number, three versions and a flag
    std::array<char, 37> text{};
    std::snprintf(text.data(), text.size(), "%08x-%04x-4%03x-8%03x-%012llx",
                  static_cast<unsigned>(identity >> 32), static_cast<unsigned>(identity & 0xFFFF),
                  static_cast<unsigned>(identity >> 16 & 0xFFF),
                  static_cast<unsigned>(identity >> 28 & 0xFFF),
                  static_cast<unsigned long long>(identity * 0x9E3779B97F4A7C15ULL >> 16));
    stream_.seekp(place_of_identifier);
    stream_.write(text.data(), 36);
    stream_.close();
  }

 private:
  std::ofstream stream_;
  openvdb::io::GridDescriptor descriptor_;
  std::int64_t places_ = 0;  // where the descriptor says where the parts of its grid are
};

// A file of OpenVDB that reports where it is cut short, which OpenVDB's own files do not.
class Source : public openvdb::io::Archive {
 public:
  explicit Source(const std::string& place) {
    stream_.exceptions(std::ios::badbit | std::ios::failbit | std::ios::eofbit);
    stream_.open(place, std::ios::binary);
    readHeader(stream_);
    openvdb::io::setStreamMetadataPtr(stream_, metadata_, false);
    setFormatVersion(stream_);
    setLibraryVersion(stream_);
    setDataCompression(stream_);
    openvdb::MetaMap().readMeta(stream_);
  }
  // Returns the grid of that name, or the first one if it is empty, and the names of all.
  openvdb::GridBase::Ptr find(const std::string& name, std::vector<std::string>& names) {
    openvdb::GridBase::Ptr found;
    for (std::int32_t i = 0, count = readGridCount(stream_); i < count; ++i) {
      openvdb::io::GridDescriptor descriptor;
      const openvdb::GridBase::Ptr grid = descriptor.read(stream_);
      names.push_back(descriptor.gridName());
      const bool is_wanted = !found && (name.empty() || descriptor.gridName() == name);
      if (is_wanted && descriptor.isInstance())
        throw std::runtime_error("this grid has the voxels of '" + plain(descriptor.instanceParentName()) +
                                 "'");
      if (is_wanted || !inputHasGridOffsets()) readGrid(grid, descriptor, stream_);
      if (is_wanted) found = grid;
      if (inputHasGridOffsets()) descriptor.seekToEnd(stream_);
    }
    return found;
  }

 private:
  std::shared_ptr<openvdb::io::StreamMetadata> metadata_ = std::make_shared<openvdb::io::StreamMetadata>();
  std::ifstream stream_;  // it refers to the pointer
};

}  // namespace voxmelt::vdb
