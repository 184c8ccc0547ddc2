// Words of the stream, as hwmodel/pipeline/model/cell_wires.h has them (docs/automaton.md, section 1). Only
// what Yosys 0.23 reads as it is meant: sized parameters, and packed structs named with their package.
/* verilator lint_off UNUSEDPARAM */
package voxmelt_pkg;
  localparam [15:0] ONE = 16'd4096;     // a full cell
  localparam [15:0] AMAX = 16'd65535;   // the most that a cell can hold
  // Air and liquid are told apart by the amount.
  localparam [1:0] AIR = 2'd0, LIQUID = 2'd1, SOLID = 2'd2, INERT = 2'd3;

  // A cell between two stages of the paper's law. A stage that does not make a side band gives zeros.
  typedef struct packed {
    logic        is_set;
    logic        touches;
    logic        beside_wall;
    logic [7:0]  pattern;
    logic [1:0]  exposed_axes;
    logic [3:0]  none;          // always 0
    logic [15:0] heat;
    logic [15:0] energy;        // of a solid, which has none: its material
    logic [15:0] amount;
    logic [1:0]  state;
  } cell_t;
  localparam CELL = 67;  // bits of cell_t

  // What memory has of a cell.
  typedef struct packed {
    logic [15:0] heat;
    logic [15:0] energy;
    logic [15:0] amount;
    logic [1:0]  state;
  } stored_t;
  localparam STORED = 50;
  localparam [49:0] BORDER = {16'd0, 16'd0, 16'd2048, INERT};

  // The greatest coordinates of a tile: planes along z, blocks of P cells along x, cells along y.
  typedef struct packed {
    logic [11:0] plane;
    logic [11:0] block;
    logic [11:0] y;
  } place_t;
endpackage
