// A drain in the cells of a lane (docs/automaton.md, section 4).
module proof (
    input logic clk,
    input logic [49:0] stored,
    input logic covers,
    input logic [15:0] rate,
    input logic [15:0] temperature,
    input logic [12:0] energy,
    input logic hot
);
  logic [49:0] treated, word;
  opening_lane dut (
      .clk(clk), .move(1'b1), .stored(stored), .covers(covers), .rate(rate), .temperature(temperature),
      .energy(energy), .hot(hot), .dither5(16'd0), .treated(treated));
  logic [7:0] age;
  moves count (.clk(clk), .age(age));
  logic [44:0] numbers, numbers1;
  assign numbers = {rate, temperature, energy};
  past #(.WIDTH(45), .N(1)) stay (.clk(clk), .d(numbers), .q(numbers1));
  always_comb if (age != 8'd0) assume (numbers == numbers1);
  always_comb assume (stored[33:18] <= stored[17:2]);
  logic acts;
  past #(.WIDTH(51), .N(26)) comes (.clk(clk), .d({covers & ~stored[1], stored}), .q({acts, word}));
  wire [15:0] f = ~acts ? 16'd0 : rate < word[17:2] ? rate : word[17:2];
  wire [15:0] left = word[17:2] - f;
  always_comb if (age == 8'd26) begin
    amount_as_the_page: assert (treated[17:2] == left);
    energy_as_the_page: assert (treated[33:18] == (word[33:18] < left ? word[33:18] : left));
    heat_and_state_stay: assert (treated[49:34] == word[49:34] && treated[1:0] == word[1:0]);
  end
endmodule
