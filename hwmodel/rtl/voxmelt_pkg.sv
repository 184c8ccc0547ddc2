// Words of the stream, as hwmodel/pipeline/model/cell_wires.h has them (docs/automaton.md, section 1). Only
// what Yosys 0.23 reads as it is meant: sized parameters, and packed structs named with their package.
/* verilator lint_off UNUSEDPARAM */
package voxmelt_pkg;
  localparam [15:0] ONE = 16'd4096;     // a full cell
  localparam [15:0] AMAX = 16'd65535;   // the most that a cell can hold
  // Air and liquid are told apart by the amount.
  localparam [1:0] AIR = 2'd0, LIQUID = 2'd1, SOLID = 2'd2, INERT = 2'd3;

  // A cell that comes to gravity, under the paper law and without heat.
  typedef struct packed {
    logic        beside_wall;
    logic [15:0] energy;
    logic [15:0] amount;
    logic [1:0]  state;
  } falling_t;

  // A cell that leaves a stage without side bands.
  typedef struct packed {
    logic [15:0] energy;
    logic [15:0] amount;
    logic [1:0]  state;
  } cell_t;
endpackage
