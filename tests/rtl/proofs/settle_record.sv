// The second scan of settle (docs/automaton.md, section 10): the levels of a run, and what flows down it.
module proof (
    input logic clk,
    input logic [92:0] word1
);
  localparam SUM = 28, LAST = 12;
  logic signed [SUM:0] level3, level4;
  logic [12:0] keeps4;
  logic [15:0] amount4;
  logic signed [17:0] gives5, comes5, flow6;
  record_scan dut (
      .clk(clk), .rst(1'b0), .move(1'b1), .word1(word1), .highest1(1'b0), .live6(1'b0), .dither6(16'd0),
      .level3(level3), .level4(level4), .keeps4(keeps4), .amount4(amount4), .gives5(gives5), .comes5(comes5),
      .flow6(flow6));
  logic [7:0] age;
  moves count (.clk(clk), .age(age));
  logic signed [SUM:0] before;
  past #(.WIDTH(SUM + 1), .N(1)) levels (.clk(clk), .d(level3), .q(before));
  logic [15:0] held;
  logic [12:0] keeps;
  past #(.WIDTH(29), .N(1)) cells (.clk(clk), .d({amount4, keeps4}), .q({held, keeps}));
  logic signed [17:0] came, gave;
  past #(.WIDTH(36), .N(1)) flows (.clk(clk), .d({comes5, gives5}), .q({came, gave}));
  always_comb
    if (age == 8'd0) begin
      assume (level3 < 29'sd268000000);  // the most that a column of 4096 cells holds is less
      assume (comes5 > -18'sd65536 && comes5 < 18'sd65536 && gives5 > -18'sd4097 && gives5 < 18'sd65536);
    end
  always_comb if (age == 8'd1) begin
    keeps_what_the_level_leaves: assert (keeps4 == (before < 29'sd0 ? 13'd0 : before > 29'sd4096 ? 13'd4096
                                                                          : before[12:0]));
    level_grows_by_one_cell: assert (level4 == before + 29'sd4096);
    gives_the_rest: assert (gives5 == $signed({2'b0, held}) - $signed({5'd0, keeps}));
    flow_telescopes: assert (flow6 == came + gave);
  end
endmodule
