// A cell of spread that has got all that it will get (docs/automaton.md, section 9).
module proof (
    input logic clk,
    input logic [49:0] stored,
    input logic [1:0] footing,
    input logic [15:0] left_amount,
    input logic [15:0] left_energy,
    input logic [15:0] amount_in,
    input logic [15:0] energy_in,
    input logic [31:0] content_in,
    input logic [15:0] dither3,
    input logic [15:0] dither4,
    input logic hot,
    input logic printed,
    input logic [47:0] alpha
);
  logic [49:0] finished;
  logic [31:0] content4;
  finish_unit dut (
      .clk(clk), .move(1'b1), .stored(stored), .footing(footing), .left_amount(left_amount), .left_energy(left_energy),
      .amount_in(amount_in), .energy_in(energy_in), .content_in(content_in), .dither3(dither3), .dither4(dither4),
      .hot(hot), .printed(printed), .alpha(alpha), .finished(finished), .content4(content4));
  logic [7:0] age;
  moves count (.clk(clk), .age(age));
  logic [49:0] word;
  logic [15:0] left, gains, kept_energy;
  past #(.WIDTH(98), .N(25)) comes (
      .clk(clk), .d({stored, left_amount, amount_in, left_energy}), .q({word, left, gains, kept_energy}));
  wire blocked = word[1];
  wire [15:0] amount = left + gains;
  wire [15:0] has = finished[17:2], energy = finished[33:18], heat = finished[49:34];

  logic signed [34:0] rubbed, rubbed3, rubbed25, kept, kept4;
  logic [31:0] content4_due;
  wire [15:0] factor = footing == 2'd0 ? alpha[15:0] : footing == 2'd1 ? alpha[31:16] : alpha[47:32];
  assign rubbed = 35'($signed({2'b0, energy_in}) * $signed({1'b0, 1'b0, factor}));
  past #(.WIDTH(35), .N(3)) friction (.clk(clk), .d(rubbed), .q(rubbed3));
  past #(.WIDTH(35), .N(22)) later (.clk(clk), .d(35'(rubbed3 + $signed({19'd0, dither3}))), .q(rubbed25));
  logic [15:0] energy_in25;
  logic printed1;
  past #(.WIDTH(16), .N(25)) as_it_came (.clk(clk), .d(energy_in), .q(energy_in25));
  past #(.WIDTH(1), .N(1)) stays (.clk(clk), .d(printed), .q(printed1));
  always_comb if (age != 8'd0) assume (printed == printed1);
  wire [16:0] together = 17'(kept_energy) + 17'(printed ? energy_in25 : rubbed25[31:16]);
  wire [16:0] least = together < 17'(amount) ? together : 17'(amount);
  assign kept = 35'($signed({2'b0, left_amount}) * $signed({1'b0, 1'b0, stored[49:34]}));
  past #(.WIDTH(32), .N(4)) contents (.clk(clk), .d(kept[31:0] + content_in), .q(content4_due));
  always_comb if (age == 8'd4) begin
    content_as_the_page: assert (content4 == content4_due);
  end
  always_comb if (age == 8'd25) begin
    amount_is_left_and_got: assert (has == (blocked ? word[17:2] : amount));
    energy_as_the_page: assert (energy == (blocked ? word[33:18] : 16'(least)));
    energy_is_no_more_than_the_amount: assert (blocked | energy <= has);
    blocked_stays: assert (~blocked | finished == word);
    state_tells_liquid: assert (blocked | finished[1:0] == (has == 16'd0 ? voxmelt_pkg::AIR : voxmelt_pkg::LIQUID));
    air_has_nothing: assert (blocked | has != 16'd0 | (energy == 16'd0 & heat == 16'd0));
  end
endmodule
