// What a cell gives in all its directions, and what it keeps (docs/automaton.md, section 9). What it gives to an axis
// may be any flow that its share allows.
module proof (
    input logic clk,
    input logic [7:0] pattern,
    input logic eight
);
  logic [15:0] flow5, part5, left8, left_energy8;
  logic [13:0] amount, energy;
  logic [15:0] left_amount, left_energy;
  logic [49:0] word5;
  logic [7:0] pattern5;
  gift_unit dut (.clk(clk), .move(1'b1), .stored(50'd0), .pattern(8'd0), .shares(512'd0), .eight(eight),
                 .amount(amount),
                 .energy(energy), .left_amount(left_amount), .left_energy(left_energy), .flow5(flow5), .part5(part5), .word5(word5), .pattern5(pattern5), .left8(left8),
                 .left_energy8(left_energy8));
  logic [7:0] age;
  moves count (.clk(clk), .age(age));
  // A flow is a fifth of what the cell holds, or a quarter where no corner gets anything. So says its share.
  wire [18:0] ways = eight ? 19'd5 : 19'd4;
  always_comb
    if (age == 8'd0) begin
      assume (19'(flow5) * ways <= 19'(word5[17:2]));
      assume (19'(part5) * ways <= 19'(word5[33:18]));
      assume (eight | pattern5[7:4] == 4'd0);
      assume (flow5 <= 16'd8192 && part5 <= 16'd8192);
    end
  logic [31:0] held;
  past #(.WIDTH(32), .N(3)) before (.clk(clk), .d(word5[33:2]), .q(held));
  always_comb if (age == 8'd3) begin
    no_more_than_it_holds: assert (left8 <= held[15:0]);
    no_more_energy_than_it_has: assert (left_energy8 <= held[31:16]);
  end

  // Directions are counted with what each of them gets.
  logic [7:0] ways4;
  logic [31:0] held4;
  past #(.WIDTH(40), .N(4)) gives (.clk(clk), .d({pattern5, word5[33:2]}), .q({ways4, held4}));
  function automatic [15:0] four(input [3:0] ways_, input [13:0] one);
    four = ((ways_[0] ? 16'(one) : 16'd0) + (ways_[1] ? 16'(one) : 16'd0))
         + ((ways_[2] ? 16'(one) : 16'd0) + (ways_[3] ? 16'(one) : 16'd0));
  endfunction
  wire [15:0] given = four(ways4[3:0], amount) + four(ways4[7:4], amount >> 2);
  wire [15:0] given_energy = four(ways4[3:0], energy) + four(ways4[7:4], energy >> 2);
  always_comb if (age == 8'd4) begin
    telescopes: assert (given + left_amount == held4[15:0]);
    energy_telescopes: assert (given_energy + left_energy == held4[31:16]);
  end
endmodule
