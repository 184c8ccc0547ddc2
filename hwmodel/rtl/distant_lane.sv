// Heat across the edges or the corners of a cell, of one lane: the pairs of a window of 2 x 2 x 2 cells
// (docs/automaton.md, section 6). The cell that comes is one corner of it, and the others came before. A pair
// is computed when its window is complete. What each of the eight gets from its pairs is known six registers
// later.
//
// A corner is seen as {matter, material, conducts, temperature}.
module distant_lane #(
    parameter CORNERS = 0,
    parameter MATERIALS = 0
) (
    input  logic        clk,
    input  logic        move,
    input  logic        west_there,       // these are known with the cell in register 1
    input  logic        below_there,
    input  logic        south_there,
    input  logic [21:0] here,
    input  logic [21:0] west,
    input  logic [21:0] below,
    input  logic [21:0] west_below,
    input  logic [21:0] south,
    input  logic [21:0] south_west,
    input  logic [21:0] south_below,
    input  logic [21:0] south_west_below,
    input  logic [(16<<(2*MATERIALS))-1:0] weights,
    input  logic [15:0] dither5,          // of the step of the word in register 5
    output logic [15:0] here7,            // what the cells at these places get
    output logic [15:0] west7,
    output logic [15:0] below7,
    output logic [15:0] west_below7,
    output logic [15:0] south7,
    output logic [15:0] south_west7,
    output logic [15:0] south_below7,
    output logic [15:0] south_west_below7
);
  localparam PAIRS = CORNERS != 0 ? 4 : 6;
  // Flow goes from q to p.
  function automatic signed [17:0] drop(input there, input [21:0] p, input [21:0] q);
    drop = there & p[16] & q[16] ? $signed({2'b0, q[15:0]}) - $signed({2'b0, p[15:0]}) : 18'sd0;
  endfunction
  logic [PAIRS*18-1:0] drops;
  wire west_floor = west_there & below_there, west_side = west_there & south_there;
  wire side_floor = below_there & south_there, all_there = west_floor & south_there;
  logic [PAIRS*5-1:0] ps, qs;
  if (CORNERS != 0) begin : across_corners
    assign drops = {drop(all_there, west, south_below), drop(all_there, south_west, below),
                    drop(all_there, west_below, south), drop(all_there, south_west_below, here)};
    assign ps = {west[21:17], south_west[21:17], west_below[21:17], south_west_below[21:17]};
    assign qs = {south_below[21:17], below[21:17], south[21:17], here[21:17]};
  end else begin : across_edges
    assign drops = {drop(side_floor, below, south), drop(side_floor, south_below, here),
                    drop(west_side, west, south), drop(west_side, south_west, here),
                    drop(west_floor, west, below), drop(west_floor, west_below, here)};
    assign ps = {below[21:17], south_below[21:17], west[21:17], south_west[21:17], west[21:17], west_below[21:17]};
    assign qs = {south[21:17], here[21:17], south[21:17], here[21:17], below[21:17], here[21:17]};
  end

  logic [PAIRS*18-1:0] drops2;
  logic [PAIRS*16-1:0] flows6;
  always_ff @(posedge clk) if (move) drops2 <= drops;
  for (genvar pair = 0; pair < PAIRS; pair++) begin : pairs
    logic signed [34:0] product5;
    logic [15:0] weight2;
    pair_weight #(.MATERIALS(MATERIALS)) of_pair (
        .clk(clk), .en(move), .p(ps[pair*5+:5]), .q(qs[pair*5+:5]), .weights(weights), .weight(weight2));
    product times_weight (
        .clk(clk), .en(move), .a($signed(drops2[pair*18+:18])), .b({1'b0, weight2}), .p(product5));
    wire [15:0] dither = dither5 + 16'(65536 * pair / PAIRS);
    wire signed [34:0] rounded = product5 + $signed({19'd0, dither});
    always_ff @(posedge clk) if (move) flows6[pair*16+:16] <= rounded[31:16];
  end

  wire [15:0] first = flows6[0+:16], second = flows6[16+:16], third = flows6[32+:16], fourth = flows6[48+:16];
  if (CORNERS != 0) begin : to_corners
    always_ff @(posedge clk)
      if (move) begin
        here7 <= -first;
        south_west_below7 <= first;
        south7 <= -second;
        west_below7 <= second;
        below7 <= -third;
        south_west7 <= third;
        south_below7 <= -fourth;
        west7 <= fourth;
      end
  end else begin : to_edges
    wire [15:0] fifth = flows6[64+:16], sixth = flows6[80+:16];
    always_ff @(posedge clk)
      if (move) begin
        here7 <= -(first + third + fifth);
        west_below7 <= first;
        west7 <= second + fourth;
        below7 <= sixth - second;
        south_west7 <= third;
        south7 <= -(fourth + sixth);
        south_below7 <= fifth;
        south_west_below7 <= 16'd0;
      end
  end
endmodule

// A word on its way through eight registers. It gets heat when the window's flows are known: those of the
// window in which it was at one place, and a move later those of the next one, in which it was below.
module distant_wait (
    input  logic        clk,
    input  logic        move,
    input  logic [69:0] word,
    input  logic [15:0] gets7,
    input  logic [15:0] gets8,
    output logic [69:0] word2,  // 1 move later
    output logic [69:0] word9   // 8 moves later
);
  logic [69:0] word7, word8;
  delay #(.WIDTH(70), .N(5)) waits (.clk(clk), .en(move), .d(word2), .q(word7));
  always_ff @(posedge clk)
    if (move) begin
      word2 <= word;
      word8 <= word7;
      if (word7[1] ^ word7[0]) word8[49:34] <= word7[49:34] + gets7;
      word9 <= word8;
      if (word8[1] ^ word8[0]) word9[49:34] <= word8[49:34] + gets8;
    end
endmodule
