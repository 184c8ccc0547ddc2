// Which of the cells of one window offer to each other: the cell that came, its south, and the west of both
// (docs/automaton.md, section 9).
//
// A side is {diagonal limit, axis limit, amount, blocked}.
module offer_unit (
    input  logic [48:0] here,
    input  logic [48:0] west,
    input  logic [48:0] south,
    input  logic [48:0] south_west,
    input  logic        has_west,
    input  logic        has_south,   // of the same pass
    input  logic        eight,
    output logic        here_south,
    output logic        south_north,
    output logic        south_goes_west,
    output logic        south_west_east,
    output logic        here_south_west,
    output logic        south_west_north_east,
    output logic        west_south_east,
    output logic        south_north_west
);
  function automatic fits(input [48:0] other, input [15:0] limit);
    fits = ~other[0] & (other[16:1] < limit);
  endfunction
  wire corner = has_west & has_south & eight;
  wire open = ~(west[0] & south[0]), open_too = ~(here[0] & south_west[0]);
  assign here_south = has_south & fits(south, here[32:17]);
  assign south_north = has_south & fits(here, south[32:17]);
  assign south_goes_west = has_west & fits(south_west, south[32:17]);
  assign south_west_east = has_west & fits(south, south_west[32:17]);
  assign here_south_west = corner & open & fits(south_west, here[48:33]);
  assign south_west_north_east = corner & open & fits(here, south_west[48:33]);
  assign west_south_east = corner & open_too & fits(south, west[48:33]);
  assign south_north_west = corner & open_too & fits(west, south[48:33]);
endmodule
