// The stage edges: heat to neighbours across an edge.
module edges_stage #(
    parameter P = 1,
    parameter MATERIALS = 0,       // bits of their numbers; 0: there is one
    parameter AXES = 1,            // what is known of a cell, and the bits of its energy that matter
    parameter WALL = 1,
    parameter TOUCHES = 1,
    parameter ENERGY = 16,
    parameter DEPTH_EAST = 4096,   // of the memories: the longest delay, less one
    parameter DEPTH_NORTH = 32768,
    parameter DEPTH_SOUTH_EAST = 4096
) (
    input  logic                clk,
    input  logic                rst,
    input  logic                in_valid,
    output logic                in_ready,
    input  logic [P*67-1:0]     in_cells,   // voxmelt_pkg::cell_t, lane 0 lowest
    output logic                out_valid,
    input  logic                out_ready,
    output logic [P*67-1:0]     out_cells,
    input  logic                follows,
    input  logic [31:0]         step,
    input  voxmelt_pkg::place_t last,
    input  logic [23:0]         lag,
    input  logic [23:0]         east,         // length of the memory towards the east
    input  logic [23:0]         north,        // from there to the north
    input  logic [23:0]         south_east,   // and from there to the east again
    input  logic                several,      // materials there are; else the first row of each table counts
    input  logic [(49<<MATERIALS)-1:0] curves,
    input  logic [15:0]         top,
    input  logic [(16<<(2*MATERIALS))-1:0] weights  // of pairs, by both materials
);
  distant_pass #(.P(P), .CORNERS(0), .MATERIALS(MATERIALS), .AXES(AXES), .WALL(WALL),
                 .TOUCHES(TOUCHES), .ENERGY(ENERGY), .DEPTH_EAST(DEPTH_EAST), .DEPTH_NORTH(DEPTH_NORTH),
                 .DEPTH_SOUTH_EAST(DEPTH_SOUTH_EAST)) pass (.*);
endmodule
