// What two cells of the viscous law exchange (docs/automaton.md, section 11), whatever their conductance.
module proof (
    input logic clk,
    input logic valid2,
    input logic [167:0] a2,
    input logic [167:0] b2,
    input logic [2:0] beside3,
    input logic [4:0] across5,
    input logic [15:0] rounding16
);
  logic [15:0] amount22, least6;
  logic [13:0] amount18, most9, most17;
  logic a_gives4, rests6, rests17, gives21;
  logic [13:0] amount21;
  pair_unit dut (
      .clk(clk), .move(1'b1), .valid2(valid2), .a2(a2), .b2(b2), .beside3(beside3), .across5(across5),
      .rounding16(rounding16), .amount22(amount22), .least6(least6), .amount18(amount18), .most9(most9),
      .most17(most17), .a_gives4(a_gives4), .rests6(rests6), .rests17(rests17), .amount21(amount21),
      .gives21(gives21));
  logic [7:0] age;
  moves count (.clk(clk), .age(age));

  // run_reader.sv has the parts of a word.
  logic [167:0] a, b;
  logic valid;
  past #(.WIDTH(337), .N(4)) comes (.clk(clk), .d({valid2, a2, b2}), .q({valid, a, b}));
  wire signed [29:0] head_a = $signed(a[61:32]), head_b = $signed(b[61:32]);
  wire from_a = head_a >= head_b;
  wire [167:0] from = from_a ? a : b, to = from_a ? b : a;
  wire [29:0] drop = from_a ? 30'(head_a - head_b) : 30'(head_b - head_a);
  wire rests = ~valid | a[167] | b[167] | ~from[166] | from[165] | (a[163] & b[163]) | drop <= 30'(from[162:138]);
  wire [15:0] top = to[166] ? 16'd65535 : 16'd4096;
  wire [15:0] room = to[15:0] < top ? top - to[15:0] : 16'd0;
  wire [15:0] least = from[15:0] < room ? from[15:0] : room;
  always_comb if (age == 8'd4) begin
    rests_as_the_page: assert (rests6 == rests);
    room_as_the_page: assert (least6 == least);
  end
  logic signed [34:0] fifth;
  logic [13:0] fifth3;
  assign fifth = 35'(18'sd13107 * $signed({1'b0, 1'b0, least6}));
  logic [15:0] least3;
  past #(.WIDTH(16), .N(3)) leasts (.clk(clk), .d(least6), .q(least3));
  past #(.WIDTH(14), .N(3)) parts (.clk(clk), .d(fifth[29:16]), .q(fifth3));
  always_comb if (age == 8'd7) begin
    most_as_the_page: assert (most9 == fifth3);
    at_most_a_fifth: assert (19'(most9) * 19'd5 <= 19'(least3));
  end
  logic [13:0] most1, amount1;
  logic rests1, gives1;
  past #(.WIDTH(15), .N(1)) flows (.clk(clk), .d({most17, rests17}), .q({most1, rests1}));
  past #(.WIDTH(15), .N(1)) signs (.clk(clk), .d({amount21, gives21}), .q({amount1, gives1}));
  always_comb if (age == 8'd1) begin
    no_more_than_that: assert (amount18 <= most1);
    none_at_rest: assert (~rests1 | amount18 == 14'd0);
    giver_loses: assert (amount22 == (gives1 ? 16'd0 - 16'(amount1) : 16'(amount1)));
  end
endmodule
