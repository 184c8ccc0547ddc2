#include "kernel/run/checkpoint/blocks.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <xxhash.h>
#include <zstd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <cstring>
#include <new>
#include <system_error>
#include <utility>

#include "kernel/run/io/file_lock.h"

namespace voxmelt::checkpoint {
namespace {

namespace fs = std::filesystem;

static_assert(std::endian::native == std::endian::little, "numbers are written as they lie in memory");

constexpr std::array<unsigned char, 8> kMagic{0x89, 'V', 'X', 'C', '\r', '\n', 0x1a, '\n'};
constexpr std::uint32_t kVersion = 1;
constexpr int kLevel = 1;  // level of zstd; higher ones take several times as long for a tenth of the bytes
constexpr const char* kEnd = "end";

// Stands before each block, and is covered by the block's checksum.
struct RawHeader {
  std::array<char, 8> kind{};
  std::uint32_t first = 0, count = 0;
  std::uint64_t raw_bytes = 0, stored_bytes = 0;
};
static_assert(sizeof(RawHeader) == 32);

std::uint64_t checksum_of(const RawHeader& header, std::span<const std::byte> stored) {
  const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state(XXH3_createState(), XXH3_freeState);
  if (state == nullptr) throw std::bad_alloc();
  XXH3_64bits_reset(state.get());
  XXH3_64bits_update(state.get(), &header, sizeof header);
  XXH3_64bits_update(state.get(), stored.data(), stored.size());
  return XXH3_64bits_digest(state.get());
}

void append(Bytes& to, std::uint64_t number) {
  const auto bytes = std::bit_cast<std::array<std::byte, 8>>(number);
  to.insert(to.end(), bytes.begin(), bytes.end());
}

bool all_zero(std::span<const std::byte> bytes) {
  return bytes.empty() ||
         (bytes[0] == std::byte{0} && std::memcmp(bytes.data(), bytes.data() + 1, bytes.size() - 1) == 0);
}

}  // namespace

void fail(const fs::path& file, const std::string& why) { throw Error(file.string() + ": error: " + why); }

std::uint64_t checksum(std::span<const std::byte> bytes) { return XXH3_64bits(bytes.data(), bytes.size()); }

std::uint64_t checksum_of_file(const fs::path& file) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream(std::fopen(file.c_str(), "rb"), std::fclose);
  const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state(XXH3_createState(), XXH3_freeState);
  if (state == nullptr) throw std::bad_alloc();
  XXH3_64bits_reset(state.get());
  Bytes piece(std::size_t{1} << 18);
  while (stream != nullptr) {
    const std::size_t count = std::fread(piece.data(), 1, piece.size(), stream.get());
    XXH3_64bits_update(state.get(), piece.data(), count);
    if (count == piece.size()) continue;
    if (std::ferror(stream.get()) != 0) break;
    return XXH3_64bits_digest(state.get());
  }
  fail(file, std::string("cannot be read: ") + std::strerror(errno));
}

Packed packed(std::span<const std::byte> raw) {
  if (all_zero(raw)) return {raw.size(), {}};
  Bytes stored(ZSTD_compressBound(raw.size()));
  const std::size_t size = ZSTD_compress(stored.data(), stored.size(), raw.data(), raw.size(), kLevel);
  if (ZSTD_isError(size) != 0) throw std::bad_alloc();  // only memory can be lacking
  stored.resize(size);
  return {raw.size(), std::move(stored)};
}

BlockWriter::BlockWriter(const fs::path& place) : place_(place), file_(place) {
  write(kMagic.data(), kMagic.size());
  const std::array<std::uint32_t, 2> version{kVersion, 0};
  write(version.data(), sizeof version);
}

void BlockWriter::write(const void* bytes, std::size_t count) {
  file_.write({static_cast<const char*>(bytes), count});
}

void BlockWriter::put(const BlockName& name, const Packed& block) {
  RawHeader header{{}, name.first, name.count, block.raw_bytes, block.stored.size()};
  std::copy_n(name.kind.begin(), std::min(name.kind.size(), header.kind.size()), header.kind.begin());
  const std::uint64_t sum = checksum_of(header, block.stored);
  write(&header, sizeof header);
  write(&sum, sizeof sum);
  write(block.stored.data(), block.stored.size());
  append(checksums_, sum);
  ++blocks_;
}

void BlockWriter::finish() {
  put({kEnd, blocks_, 0}, {0, Bytes(checksums_)});
  file_.commit();
  io::flush_entry(place_);
}

BlockReader::BlockReader(const fs::path& file) : path_(file) {
  std::error_code error;
  if (fs::is_directory(file, error)) fail(file, "is a folder, not a checkpoint");
  if (!fs::exists(file, error)) fail(file, "there is no such file");
  if (!fs::is_regular_file(file, error)) fail(file, "is no file that could be a checkpoint");
  file_.reset(std::fopen(file.c_str(), "rb"));
  if (file_ == nullptr) fail(file, std::string("cannot be read: ") + std::strerror(errno));
  left_ = fs::file_size(file);
  std::array<unsigned char, 8> magic{};
  if (left_ < sizeof magic) fail(file, "is no checkpoint of voxmelt");
  read(magic.data(), sizeof magic);
  if (magic != kMagic) fail(file, "is no checkpoint of voxmelt");
  std::array<std::uint32_t, 2> version{};
  read(version.data(), sizeof version);
  if (version[0] != kVersion || version[1] != 0)
    fail(file, "has version " + std::to_string(version[0]) + (version[1] != 0 ? " with flags" : "") +
                   " of the format; this program reads version " + std::to_string(kVersion));
}

void BlockReader::read(void* bytes, std::size_t count) {
  if (count > left_) fail(path_, "is cut off after " + std::to_string(fs::file_size(path_)) + " bytes");
  if (std::fread(bytes, 1, count, file_.get()) != count)
    fail(path_, std::string("cannot be read: ") +
                    (std::ferror(file_.get()) != 0 ? std::strerror(errno) : "it became shorter"));
  left_ -= count;
}

BlockReader::Header BlockReader::take() {
  const std::string number = "block " + std::to_string(blocks_);
  RawHeader header;
  std::uint64_t sum = 0;
  read(&header, sizeof header);
  read(&sum, sizeof sum);
  if (header.stored_bytes > left_) fail(path_, number + " is cut off, or damaged");
  Header block;
  block.name.kind.assign(header.kind.data(), ::strnlen(header.kind.data(), header.kind.size()));
  block.name.first = header.first;
  block.name.count = header.count;
  block.raw_bytes = header.raw_bytes;
  block.stored.resize(header.stored_bytes);
  read(block.stored.data(), block.stored.size());
  if (checksum_of(header, block.stored) != sum)
    fail(path_, number + " is damaged: its checksum does not fit");
  if (block.name.kind != kEnd) {
    append(checksums_, sum);
    ++blocks_;
  }
  return block;
}

BlockReader::Header BlockReader::take(const BlockName& name) {
  Header block = take();
  if (block.name != name)
    fail(path_, "there is block '" + block.name.kind + "' from " + std::to_string(block.name.first) +
                    " where '" + name.kind + "' from " + std::to_string(name.first) + " should be");
  return block;
}

void BlockReader::unpack(const Header& block, std::span<std::byte> raw) const {
  const std::size_t size = ZSTD_decompress(raw.data(), raw.size(), block.stored.data(), block.stored.size());
  if (ZSTD_isError(size) != 0 || size != raw.size())
    fail(path_, "block " + std::to_string(blocks_ - 1) + " ('" + block.name.kind + "') cannot be unpacked");
}

Bytes BlockReader::next(const BlockName& name, std::uint64_t most) {
  const Header block = take(name);
  if (block.raw_bytes > most) fail(path_, "block '" + name.kind + "' is too large");
  Bytes raw(block.raw_bytes);
  if (!block.stored.empty()) unpack(block, raw);
  return raw;
}

bool BlockReader::next_is_empty(const BlockName& name, std::span<std::byte> raw) {
  const Header block = take(name);
  if (block.raw_bytes != raw.size())
    fail(path_, "block '" + name.kind + "' has " + std::to_string(block.raw_bytes) + " bytes, not " +
                    std::to_string(raw.size()));
  if (block.stored.empty()) return true;
  unpack(block, raw);
  return false;
}

bool BlockReader::next_is(std::string_view kind) {
  if (left_ < sizeof(RawHeader)) return false;
  RawHeader header;
  const bool is_read = std::fread(&header, sizeof header, 1, file_.get()) == 1;
  if (!is_read || std::fseek(file_.get(), -static_cast<long>(sizeof header), SEEK_CUR) != 0)
    fail(path_, "cannot be read");
  return kind == std::string_view(header.kind.data(), ::strnlen(header.kind.data(), header.kind.size()));
}

void BlockReader::finish() {
  const std::uint32_t blocks = blocks_;
  const Header block = take();
  if (block.name != BlockName{kEnd, blocks, 0} || block.stored != checksums_)
    fail(path_, "its last block does not fit the others");
  if (left_ != 0) fail(path_, "has bytes behind its last block");
}

std::vector<BlockReader::Listed> BlockReader::list(const fs::path& file) {
  BlockReader reader(file);
  std::vector<Listed> blocks;
  for (;;) {
    const Header block = reader.take();
    blocks.push_back({block.name, block.raw_bytes, block.stored.size()});
    if (block.name.kind != kEnd) continue;
    if (block.name.first + 1 != blocks.size() || block.stored != reader.checksums_)
      fail(file, "its last block does not fit the others");
    if (reader.left_ != 0) fail(file, "has bytes behind its last block");
    return blocks;
  }
}

}  // namespace voxmelt::checkpoint
