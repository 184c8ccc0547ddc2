// What a cell gives in all its directions, and what it keeps (docs/automaton.md, section 9). What it gives to an axis
// may be any flow that its share allows. Friction acts at its end (reading `text`).
module proof (
    input logic clk,
    input logic [7:0] pattern,
    input logic eight,
    input logic by_table
);
  logic [63:0] flow5, part5;
  logic [255:0] axes;
  logic [63:0] corner;
  logic [15:0] left_amount, left_energy;
  logic [49:0] word5;
  logic [7:0] pattern5;
  gift_unit dut (.clk(clk), .move(1'b1), .stored(50'd0), .pattern(8'd0), .footing(2'd0), .shares(512'd0),
                 .by_table(by_table), .table_shares(1024'd0), .printed(1'b0), .alpha(48'd0), .eight(eight), .axes(axes),
                 .corner(corner), .left_amount(left_amount), .left_energy(left_energy), .flow5(flow5), .part5(part5),
                 .word5(word5), .pattern5(pattern5));
  logic [7:0] age;
  moves count (.clk(clk), .age(age));
  // A flow is a fifth of what the cell holds, or a quarter where no corner gets anything. So says its share. The shares
  // of a table are at most 1 together.
  function automatic [18:0] four(input [3:0] to, input [15:0] a, input [15:0] b, input [15:0] c, input [15:0] d);
    four = ((to[0] ? 19'(a) : 19'd0) + (to[1] ? 19'(b) : 19'd0)) + ((to[2] ? 19'(c) : 19'd0) + (to[3] ? 19'(d) : 19'd0));
  endfunction
  wire [18:0] ways = eight ? 19'd5 : 19'd4;
  wire alike = by_table | (flow5[31:16] == flow5[15:0] && flow5[47:32] == flow5[15:0] && flow5[63:48] == flow5[15:0]
             && part5[31:16] == part5[15:0] && part5[47:32] == part5[15:0] && part5[63:48] == part5[15:0]);
  always_comb
    if (age == 8'd0) begin
      assume (alike);
      assume (by_table | (19'(flow5[15:0]) * ways <= 19'(word5[17:2])));
      assume (by_table | (19'(part5[15:0]) * ways <= 19'(word5[33:18])));
      assume (~by_table | four(pattern5[3:0], flow5[15:0], flow5[31:16], flow5[47:32], flow5[63:48]) <= 19'(word5[17:2]));
      assume (~by_table | four(pattern5[3:0], part5[15:0], part5[31:16], part5[47:32], part5[63:48]) <= 19'(word5[33:18]));
      assume ((eight & ~by_table) | pattern5[7:4] == 4'd0);
      assume (flow5[15:0] <= 16'd8192 && flow5[31:16] <= 16'd8192 && flow5[47:32] <= 16'd8192 && flow5[63:48] <= 16'd8192);
      assume (part5[15:0] <= 16'd8192 && part5[31:16] <= 16'd8192 && part5[47:32] <= 16'd8192 && part5[63:48] <= 16'd8192);
    end

  // Directions are counted with what each of them gets.
  logic [7:0] ways4, ways6;
  logic [31:0] held6;
  past #(.WIDTH(40), .N(6)) gives (.clk(clk), .d({pattern5, word5[33:2]}), .q({ways6, held6}));
  past #(.WIDTH(8), .N(4)) directions (.clk(clk), .d(pattern5), .q(ways4));
  function automatic [15:0] sum(input [3:0] to, input [15:0] a, input [15:0] b, input [15:0] c, input [15:0] d);
    sum = ((a & {16{to[0]}}) + (b & {16{to[1]}})) + ((c & {16{to[2]}}) + (d & {16{to[3]}}));
  endfunction
  wire [15:0] given = sum(ways4[3:0], axes[15:0], axes[79:64], axes[143:128], axes[207:192]);
  wire [15:0] corners = sum(ways4[7:4], corner[15:0], corner[15:0], corner[15:0], corner[15:0]);
  wire [15:0] given_energy = sum(ways4[3:0], axes[31:16], axes[95:80], axes[159:144], axes[223:208]);
  wire [15:0] corners_energy = sum(ways4[7:4], corner[31:16], corner[31:16], corner[31:16], corner[31:16]);
  logic [15:0] given6, given_energy6, corners6, corners_energy6;
  past #(.WIDTH(64), .N(2)) sums (
      .clk(clk), .d({given, corners, given_energy, corners_energy}), .q({given6, corners6, given_energy6, corners_energy6}));
  always_comb if (age == 8'd6) begin
    no_more_than_it_holds: assert (left_amount <= held6[15:0]);
    no_more_energy_than_it_has: assert (left_energy <= held6[31:16]);
    telescopes: assert (left_amount + corners6 + given6 == held6[15:0]);
    energy_telescopes: assert (left_energy + corners_energy6 + given_energy6 == held6[31:16]);
  end
endmodule
