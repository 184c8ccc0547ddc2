// The stage corners: heat to neighbours across a corner.
module corners_stage #(
    parameter P = 1,
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
    input  logic [15:0]         melting_point,
    input  logic [15:0]         latent_heat,
    input  logic [15:0]         weight
);
  distant_pass #(.P(P), .CORNERS(1), .DEPTH_EAST(DEPTH_EAST), .DEPTH_NORTH(DEPTH_NORTH),
                 .DEPTH_SOUTH_EAST(DEPTH_SOUTH_EAST)) pass (.*);
endmodule
