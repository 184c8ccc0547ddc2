// What a cell of the lane gets through its faces (docs/automaton.md, section 6, rule 1). Its western, lower and
// southern neighbours are seen with it in register 1.
module proof (
    input logic clk,
    input logic [70:0] word_in,
    input logic west_there,
    input logic below_there,
    input logic south_there,
    input logic [70:0] west,
    input logic [70:0] south,
    input logic east_there,
    input logic [15:0] east_flow6,
    input logic [15:0] weight,
    input logic [15:0] dither_x,
    input logic [15:0] dither_y,
    input logic [15:0] dither_z
);
  logic [70:0] word1, word2, word9;
  logic [15:0] west_flow6, south_flow6, flow_y6;
  logic signed [17:0] drop_x2, drop_y2, drop_z2;
  conduction_lane dut (
      .clk(clk), .move(1'b1), .word_in(word_in), .west_there(west_there), .below_there(below_there),
      .south_there(south_there), .at_side(1'b0), .at_end(1'b0), .west(west), .south(south), .east(71'd0),
      .east_there(east_there), .east_flow6(east_flow6), .weights(weight), .dither_x(dither_x), .dither_y(dither_y),
      .dither_z(dither_z), .word1(word1), .word2(word2), .word9(word9), .west_flow6(west_flow6),
      .south_flow6(south_flow6), .flow_y6(flow_y6), .drop_x2(drop_x2),
      .drop_y2(drop_y2), .drop_z2(drop_z2));
  logic [7:0] age;
  moves count (.clk(clk), .age(age));
  logic [15:0] weight1;
  past #(.WIDTH(16), .N(1)) stays (.clk(clk), .d(weight), .q(weight1));
  always_comb if (age != 8'd0) assume (weight == weight1);

  // Matter conducts, and so does a wall that has heat.
  function automatic matter(input [1:0] state);
    matter = state == voxmelt_pkg::LIQUID || state == voxmelt_pkg::SOLID;
  endfunction
  function automatic conducts(input [70:0] word);
    conducts = matter(word[1:0]) || (word[1:0] == voxmelt_pkg::INERT && word[49:34] != 16'd0);
  endfunction
  function automatic signed [17:0] drop(input there, input [70:0] p, input [70:0] q);
    drop = there & conducts(p) & conducts(q) ? $signed({2'b0, q[65:50]}) - $signed({2'b0, p[65:50]}) : 18'sd0;
  endfunction
  function automatic signed [34:0] times(input signed [17:0] a, input [15:0] b);
    times = 35'(a * $signed({1'b0, 1'b0, b}));
  endfunction
  logic signed [17:0] x1, y1, z1;
  past #(.WIDTH(54), .N(1)) drops (
      .clk(clk),
      .d({drop(west_there, west, word1), drop(below_there, word2, word1), drop(south_there, south, word1)}),
      .q({x1, y1, z1}));
  always_comb if (age == 8'd1) begin
    drops_as_the_page: assert (drop_x2 == x1 && drop_y2 == y1 && drop_z2 == z1);
  end
  logic signed [34:0] x4, y4, z4, x5, y5, z5;
  past #(.WIDTH(105), .N(3)) products (
      .clk(clk), .d({times(drop_x2, weight), times(drop_y2, weight), times(drop_z2, weight)}), .q({x4, y4, z4}));
  past #(.WIDTH(105), .N(1)) rounded (
      .clk(clk),
      .d({35'(x4 + $signed({19'd0, dither_x})) >>> 16, 35'(y4 + $signed({19'd0, dither_y})) >>> 16,
          35'(z4 + $signed({19'd0, dither_z})) >>> 16}),
      .q({x5, y5, z5}));
  logic signed [34:0] x_before;
  past #(.WIDTH(35), .N(1)) same (.clk(clk), .d(x4), .q(x_before));
  logic signed [17:0] drop5;
  past #(.WIDTH(18), .N(4)) same_drop (.clk(clk), .d(drop_x2), .q(drop5));
  always_comb if (age == 8'd5) begin
    no_more_than_the_drop: assert (drop5 >= 18'sd0 ? {2'b0, west_flow6} <= drop5
                                                   : {2'b0, 16'd0 - west_flow6} <= 18'd0 - drop5);
    west_as_the_page: assert (west_flow6 == x5[15:0]);
    below_as_the_page: assert (flow_y6 == y5[15:0]);
    south_as_the_page: assert (south_flow6 == z5[15:0]);
    none_without_a_drop: assert (x_before != 35'sd0 || west_flow6 == 16'd0);
  end

  // What it gave to the west, below and to the south, and what came from above and from the east.
  logic [70:0] word9_due;
  logic [15:0] gave, gave3, east2, above1;
  past #(.WIDTH(71), .N(8)) waits (.clk(clk), .d(word1), .q(word9_due));
  assign gave = west_flow6 + flow_y6 + south_flow6;
  past #(.WIDTH(16), .N(3)) gifts (.clk(clk), .d(gave), .q(gave3));
  past #(.WIDTH(16), .N(3)) from_east (.clk(clk), .d(east_there ? east_flow6 : 16'd0), .q(east2));
  past #(.WIDTH(16), .N(2)) from_above (.clk(clk), .d(flow_y6), .q(above1));
  wire [15:0] heat = word9_due[49:34] - gave3 + east2 + above1;
  always_comb if (age == 8'd8) begin
    books_all: assert (~matter(word9_due[1:0]) | word9[49:34] == heat);
    others_stay: assert (matter(word9_due[1:0]) | word9[49:34] == word9_due[49:34]);
    amounts_stay: assert (word9[33:0] == word9_due[33:0]);
  end
endmodule
