// A vent in the cells of a lane (docs/automaton.md, section 4).
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
  always_comb assume (energy <= 13'd4096);
  always_comb assume (stored[33:18] <= stored[17:2]);
  logic acts;
  past #(.WIDTH(51), .N(26)) comes (.clk(clk), .d({covers & ~stored[1], stored}), .q({acts, word}));
  wire [15:0] space = 16'd65535 - word[17:2];
  wire [15:0] f = ~acts ? 16'd0 : rate < space ? rate : space;
  always_comb if (age == 8'd26) begin
    amount_as_the_page: assert (17'(treated[17:2]) == 17'(word[17:2]) + 17'(f));
    energy_is_no_more_than_the_amount: assert (treated[33:18] <= treated[17:2]);
    others_stay: assert (acts | treated == word);
    state_stays: assert (treated[1:0] == word[1:0]);
  end
endmodule
