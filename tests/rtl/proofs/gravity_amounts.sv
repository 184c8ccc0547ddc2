// A pair of gravity (docs/automaton.md, section 8): q came, and p is the cell below with its present amount,
// which may be any. In register 6 the pair is decided, and seven registers later p is complete.
module proof (
    input logic clk,
    input voxmelt_pkg::cell_t cell_in,
    input logic in_run,
    input logic first,
    input logic top,
    input logic paper,
    input logic [16:0] factor,
    input logic [16:0] wall_factor,
    input logic [15:0] minimum,
    input logic [15:0] hang
);
  logic [15:0] low, high, after13;
  logic low_blocked;
  gravity_lane dut (
      .clk(clk), .rst(1'b0), .move(1'b1), .cell_in(cell_in), .in_run(in_run), .first(first), .top(top),
      .live13(1'b0), .dither13(16'd0), .dither18(16'd0), .paper(paper), .hot(1'b0), .printed(1'b0),
      .factor(factor), .wall_factor(wall_factor), .minimum(minimum), .hang(hang), .beta(19'd0),
      .low(low), .high(high), .low_blocked(low_blocked), .after13(after13));
  logic [7:0] age;
  moves count (.clk(clk), .age(age));

  voxmelt_pkg::cell_t q, above;
  logic run6, first6, top6;
  past #(.WIDTH(70), .N(6)) comes (.clk(clk), .d({cell_in, in_run, first, top}), .q({q, run6, first6, top6}));
  past #(.WIDTH(67), .N(5)) next (.clk(clk), .d(cell_in), .q(above));
  logic [66:0] numbers, numbers1;
  assign numbers = {paper, factor, wall_factor, minimum, hang};
  past #(.WIDTH(67), .N(1)) stay (.clk(clk), .d(numbers), .q(numbers1));
  always_comb if (age != 8'd0) assume (numbers == numbers1);

  wire [15:0] a_p = low, a_q = q.amount;
  wire touches = q.beside_wall | top6 | above.state[1];
  logic signed [34:0] part;
  assign part = 35'($signed({2'b0, a_q}) * $signed({1'b0, q.beside_wall ? wall_factor : factor}));
  wire [16:0] want = 17'(part[31:16]) + 17'(minimum);
  wire rests = (q.is_set | (hang > 16'd0 & a_q < hang & a_p == 16'd0)) & touches;
  wire [15:0] ready = rests ? 16'd0 : want < 17'(a_q) ? want[15:0] : a_q;
  wire pair = ~first6 & ~low_blocked & ~q.state[1];
  wire down = pair & a_q > 16'd0 & a_p < 16'd4096 & (paper | ~run6);
  wire up = pair & paper & a_p > 16'd4096;
  wire [15:0] space = down ? 16'd4096 - a_p : 16'd65535 - a_q, spare = down ? ready : a_p - 16'd4096;
  wire [15:0] f = ~(down | up) ? 16'd0 : spare < space ? spare : space;
  wire [17:0] q_after = down ? 18'(a_q) - 18'(f) : 18'(a_q) + 18'(f);
  wire [17:0] p_after = down ? 18'(a_p) + 18'(f) : 18'(a_p) - 18'(f);
  logic [17:0] p_after13;
  logic [16:0] both13;
  logic [15:0] high13;
  past #(.WIDTH(51), .N(7)) later (
      .clk(clk), .d({p_after, 17'(a_p) + 17'(a_q), high}), .q({p_after13, both13, high13}));
  always_comb if (age == 8'd6) begin
    as_the_page: assert (18'(high) == q_after);
    viscous_only_falls: assert (paper | high <= a_q);
    runs_stay: assert (paper | ~run6 | high == a_q);
    first_stays: assert (~first6 | high == a_q);
  end
  always_comb if (age == 8'd13) begin
    lower_as_the_page: assert (18'(after13) == p_after13);
    nothing_lost: assert (17'(after13) + 17'(high13) == both13);
  end
endmodule
