// The energy of a pair of gravity (docs/automaton.md, section 8), in both readings. In register 12 flow and gain are
// known, and may be any that gravity_flow proves. In register 13 the energy `held` of the lower cell p, which may
// be any up to its amount, meets that of the upper one q.
module proof (
    input logic clk,
    input logic paper,
    input logic printed
);
  logic [15:0] stays12, flow12, low12, after12, high12, held, held_next, energy14, amount14;
  logic signed [36:0] gain12;
  voxmelt_pkg::cell_t q;
  logic down12, up12;
  gravity_lane dut (
      .clk(clk), .rst(1'b0), .move(1'b1), .cell_in('0), .in_run(1'b0), .first(1'b0), .top(1'b0),
      .live13(1'b0), .dither13(16'd0), .dither18(16'd0), .paper(paper), .hot(1'b0), .printed(printed),
      .factor(17'd0), .wall_factor(17'd0), .minimum(16'd0), .hang(16'd0), .beta(19'd0), .cell12(q),
      .down12(down12), .up12(up12), .stays12(stays12), .flow12(flow12), .low12(low12), .after12(after12),
      .high12(high12), .gain12(gain12), .held(held), .held_next(held_next), .energy14(energy14),
      .amount14(amount14));
  logic [7:0] age;
  moves count (.clk(clk), .age(age));
  logic [1:0] numbers1;
  past #(.WIDTH(2), .N(1)) stay (.clk(clk), .d({paper, printed}), .q(numbers1));
  always_comb if (age != 8'd0) assume ({paper, printed} == numbers1);

  wire [15:0] pays = ~down12 ? 16'd0 : q.energy < flow12 ? q.energy : flow12;
  always_comb
    if (age == 8'd0) begin
      assume (~(down12 & up12));
      assume (q.energy <= q.amount);
      assume (stays12 == q.energy - pays);
      assume (down12 ? flow12 <= q.amount && high12 == q.amount - flow12
            : up12 ? flow12 <= 16'd65535 - q.amount && high12 == q.amount + flow12
            : high12 == q.amount && flow12 == 16'd0);
      assume (~down12 | 17'(low12) + 17'(flow12) <= 17'd4096);
      assume (~up12 | 17'(flow12) + 17'd4096 <= 17'(low12));
      assume (after12 == (up12 ? low12 - flow12 : low12 + flow12));
    end

  logic [15:0] e_q, a_q, a_p, flow, high13, stays;
  logic [18:0] b;
  logic down, up;
  past #(.WIDTH(117), .N(1)) later (
      .clk(clk), .d({stays12, gain12[34:16], q.energy, q.amount, low12, flow12, high12, down12, up12}),
      .q({stays, b, e_q, a_q, a_p, flow, high13, down, up}));
  always_comb if (age == 8'd1) assume (held <= a_p);

  // Section 8. Only the last line of the page takes E_q after its loss.
  wire [16:0] room = 17'(a_p) + 17'(flow) - 17'(held);
  wire [18:0] by_text = b < 19'(room) ? b : 19'(room);
  wire [18:0] by_print = by_text < 19'(e_q) ? by_text : 19'(e_q);
  wire [16:0] least = 17'(a_q) - 17'(flow);
  wire [16:0] left = printed ? 17'(e_q) - by_print[16:0] : 17'(stays);
  wire [15:0] climbs = held < flow ? held : flow;
  wire [16:0] q_after = down ? (left < least ? left : least) : up ? 17'(e_q) + 17'(climbs) : 17'(e_q);
  wire [16:0] p_after = down ? 17'(held) + (printed ? by_print[16:0] : by_text[16:0])
                      : up ? 17'(held) - 17'(climbs) : 17'(held);
  logic [16:0] p_after1, both1;
  logic [15:0] held_next1;
  logic rises1;
  past #(.WIDTH(51), .N(1)) last (
      .clk(clk), .d({p_after, 17'(held) + 17'(e_q), held_next, up}), .q({p_after1, both1, held_next1, rises1}));
  always_comb if (age == 8'd1) begin
    upper_as_the_page: assert (17'(held_next) == q_after);
    upper_has_no_more_than_its_amount: assert (held_next <= high13);
  end
  always_comb if (age == 8'd2) begin
    lower_as_the_page: assert (17'(energy14) == p_after1);
    lower_has_no_more_than_its_amount: assert (energy14 <= amount14);
    climbing_loses_nothing: assert (~rises1 | 17'(energy14) + 17'(held_next1) == both1);
  end
endmodule
