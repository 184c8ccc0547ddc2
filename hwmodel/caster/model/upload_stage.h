// Between two pictures the host sends an upload to the ray caster. Words of registers and small memories come
// first, one a cycle. Bursts follow, as fast as the memory's bus takes them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "hwmodel/caster/model/configuration.h"
#include "hwmodel/caster/model/gather.h"
#include "hwmodel/caster/model/layout.h"
#include "hwmodel/caster/model/stage.h"
#include "hwmodel/fabric/fifo.h"

namespace voxmelt::hwmodel::raycast {

struct Upload {
  std::int64_t words = 0;               // words of registers and small memories
  std::vector<std::int64_t> addresses;  // addresses of the bursts
  std::vector<std::uint8_t> bytes;      // kBurst for each of them

  std::int64_t bursts() const { return addresses.size(); }
  void add(std::int64_t address, const std::uint8_t* from, int count) {
    for (int at = 0; at < count; at += kBurst) addresses.push_back(address + at);
    bytes.insert(bytes.end(), from, from + count);
  }
};

class UploadStage final : public Stage {
 public:
  // The bus takes `bus_bytes` in a cycle. A DRAM takes bursts as it can.
  UploadStage(const Upload& upload, int bus_bytes)
      : Stage("upload"),
        upload_(upload),
        words_(upload.words),
        beats_((kBurst + bus_bytes - 1) / bus_bytes) {}
  void connect(Fifo<LineRequest>& out) { out_ = &out; }
  bool done() const { return words_ == 0 && next_ == upload_.addresses.size(); }

 private:
  Did cycle() override {
    if (words_ > 0) {
      --words_;
      return Did::busy;
    }
    if (done()) return Did::starved;
    if (beats_left_ > 0) {  // the bus still carries the burst before
      --beats_left_;
      return Did::memory;
    }
    if (!out_->ready()) return Did::blocked;
    LineRequest& request = *out_->put();
    request = {0, 0, upload_.addresses[next_], kBurst, true, {}};
    std::memcpy(request.data.data(), upload_.bytes.data() + next_ * kBurst, kBurst);
    ++next_;
    beats_left_ = beats_ - 1;
    return Did::busy;
  }

  const Upload& upload_;
  std::int64_t words_;
  std::size_t next_ = 0;
  int beats_, beats_left_ = 0;
  Fifo<LineRequest>* out_ = nullptr;
};

struct UploadEnd {
  std::int64_t cycles = 0;
  Account account;
};
// Sends it all. It takes no SystemC, because nothing else runs between two pictures.
UploadEnd run_upload(const Upload& upload, Memory& memory, const Configuration& configuration);

}  // namespace voxmelt::hwmodel::raycast
