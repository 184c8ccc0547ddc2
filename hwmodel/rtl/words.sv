// Words of memory and those of a channel.
module stored_of (
    input  voxmelt_pkg::cell_t cell_in,
    output logic [49:0]        stored    // voxmelt_pkg::stored_t
);
  assign stored = {cell_in.heat, cell_in.energy, cell_in.amount, cell_in.state};
endmodule

// A solid has no energy, and its material stands there (docs/automaton.md, section 1).
module material_of (
    input  voxmelt_pkg::stored_t stored,
    output logic [3:0]           material  // 0 of what is not solid
);
  assign material = stored.state == voxmelt_pkg::SOLID ? stored.energy[3:0] : 4'd0;
endmodule

module cell_of (
    input  voxmelt_pkg::stored_t stored,
    input  logic [1:0]           exposed_axes,
    input  logic [7:0]           pattern,
    input  logic                 beside_wall,
    input  logic                 touches,
    input  logic                 is_set,
    output voxmelt_pkg::cell_t   cell_out
);
  assign cell_out = {is_set, touches, beside_wall, pattern, exposed_axes, 4'd0, stored.heat, stored.energy,
                     stored.amount, stored.state};
endmodule

// The word of a cell that spreads. A set cell has the state of air there, and holds something.
module coded_of (
    input  voxmelt_pkg::cell_t cell_in,
    output logic [49:0]        coded
);
  assign coded = {cell_in.heat, cell_in.energy, cell_in.amount,
                  cell_in.is_set & ~cell_in.state[1] ? voxmelt_pkg::AIR : cell_in.state};
endmodule
