// The numbers of a memory are its shape, and the rules of its data sheet in cycles of its clock. They come
// from the files in hwmodel/memory/sheets, which name the source of each.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hwmodel/fabric/memory_port.h"

namespace voxmelt::hwmodel::memory {

// One supply of a part, by the currents of its data sheet in mA. Those of a VPP are called IPP there.
struct Rail {
  std::string name;
  double volts = 0;
  double idd0 = 0;              // rows of one bank open and close every tRC
  double idd2n = 0, idd3n = 0;  // standby: all banks closed, and all open
  double idd4r = 0, idd4w = 0;  // reads or writes follow without a gap
  double idd5 = 0;              // refreshes follow without a gap (IDD5B)
};

struct Parameters {
  std::string name, title;
  int mhz = 0;        // the memory's clock, in which all cycles below count
  int data_rate = 2;  // transfers on a wire in a cycle: 2 at both edges; clocks for data alone make 4 or 8

  // Each is a power of 2. Columns of a row are as wide as the channel.
  int channels = 1, ranks = 1, groups = 1, banks = 1;  // `banks` counts those of a group
  int rows = 1, columns = 1, width_bits = 64, transfers = 8;

  // All of these are cycles.
  int cl = 0, cwl = 0;                // from a column command to its data
  int read_more = 0, write_more = 0;  // data may lie so much later (tDQSCK and tDQSS of LPDDR4)
  int rcd = 0;                        // ACT to RD and WR
  int rp = 0, rp_all = 0;             // PRE to ACT, for one bank and for all
  int ras = 0, rc = 0;                // ACT to PRE, and to ACT of the same bank
  int ccd_s = 0, ccd_l = 0;           // RD to RD, WR to WR: in another group, in the same one
  int ccd_l_write = 0;                // WR to WR in the same group
  int rrd_s = 0, rrd_l = 0;           // ACT to ACT of another bank: likewise
  int faw = 0;                        // at most four ACT in so many cycles
  int wr = 0;                         // end of written data to PRE
  int wtr_s = 0, wtr_l = 0;           // end of written data to RD
  int rtp = 0;                        // RD to PRE
  int ppd = 0;                        // PRE to PRE of any banks of a rank
  int read_to_write = 0;              // cycles without data between read and written data
  int rank_switch = 0;                // cycles without data between those of two ranks
  int refi = 0, rfc = 0;              // between two REF; REF to the next command

  // A refresh of banks (REFpb, REFsb) has its own times. A sheet may have them, and choose it or not.
  bool by_bank = false;                // chooses it
  int groups_at_once = 0;              // groups in which one command refreshes a bank; 0: the sheet has none
  int refi_bank = 0, rfc_bank = 0;     // between two of them in the mean; to the next command for these banks
  int ref_to_ref = 0, ref_to_act = 0;  // to the next one, and to ACT of other banks
  int act_slots = 1, column_slots = 1, pre_slots = 1, ref_slots = 1;  // cycles of the command bus
  bool two_buses = false;    // column commands have a bus of their own
  int interface_cycles = 0;  // further cycles of a read on its way through controller and pins

  int parts = 1;            // that share the wires of a channel
  std::vector<Rail> rails;  // of each part; none: the sheet has no currents

  int beats() const { return transfers / data_rate; }  // data cycles of one column command
  int column_bytes() const { return width_bits / 8 * transfers; }
  int columns_of_request() const { return kBurst / column_bytes(); }  // column commands
  int banks_of_rank() const { return groups * banks; }
  int refreshes_of_rank() const {
    return banks_of_rank() / groups_at_once;
  }  // of banks, until it is their turn again
  std::int64_t row_bytes() const { return std::int64_t{columns} * (width_bits / 8); }
  std::int64_t bytes() const { return row_bytes() * rows * banks_of_rank() * ranks * channels; }
  // Returns the peak rate in 10^6 bytes a second: 64 bits at both edges of 1200 MHz give 19200.
  std::int64_t peak() const { return std::int64_t{mhz} * data_rate * width_bits / 8 * channels; }
};

// Holds what the controller may choose.
struct Policy {
  int reads = 32, writes = 64;  // entries of the two queues of each channel
  int high = 48, low = 8;       // writes begin at `high` and end at `low`, unless no read waits
  int batch = 48;               // requests of one kind, while the other kind waits
  int linger = 32;              // cycles without a read after which a few writes begin, too
  int starve = 2000;            // cycles after which a request has its bank for itself
  int inbox = 8;                // requests of a port that no queue has taken
  int under_way = 256;          // reads of a port without a reply
};

}  // namespace voxmelt::hwmodel::memory
