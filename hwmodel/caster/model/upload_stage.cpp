#include "hwmodel/caster/model/upload_stage.h"

#include <cstdint>
#include <stdexcept>

#include "hwmodel/caster/model/line_block.h"
#include "hwmodel/fabric/fifo.h"
#include "hwmodel/memory/chosen_memory.h"

namespace voxmelt::hwmodel::raycast {
namespace {

constexpr std::int64_t kHangAfter = 4000;  // cycles in which nothing moves

}  // namespace

UploadEnd run_upload(const Upload& upload, Memory& memory, const Configuration& c) {
  Fifo<LineRequest> requests("upload -> memory", 0, 1, c.fifo_depth, c.stall_seed);
  Fifo<LineReply> replies("memory -> upload", 1, 1, c.fifo_depth, c.stall_seed);
  memory::Choice untraced = c.memory();
  untraced.trace.clear();
  memory::ChosenMemory chosen(untraced);
  LineBlock block(memory, chosen.memory(), c.bus_bytes);
  block.connect(requests, replies);
  UploadStage stage(upload, c.dram ? kBurst : c.bus_bytes);
  stage.connect(requests);
  UploadEnd end;
  std::int64_t idle = 0;
  while (!stage.done() || block.counts().written_bytes < upload.bursts() * kBurst) {
    const bool sent = stage.run(), taken = block.cycle(), written = chosen.memory().cycle();
    ++end.cycles;
    requests.commit();
    idle = sent || taken || written ? 0 : idle + 1;
    if (idle > kHangAfter && !chosen.memory().works())
      throw std::logic_error("the upload hangs between its stage and the memory");
  }
  stage.end_pass();
  end.account = stage.account();
  return end;
}

}  // namespace voxmelt::hwmodel::raycast
