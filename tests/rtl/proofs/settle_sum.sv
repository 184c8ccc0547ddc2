// The first scan of settle (docs/automaton.md, section 10): what a run's sum is made of. A run begins with any
// first cell, and the proof goes from each of its cells to the next.
module proof (
    input logic clk,
    input voxmelt_pkg::cell_t cell_in,
    input logic bottom
);
  localparam SUM = 28, LAST = 12;
  localparam [2:0] INNER = 3'd3, FIRST = 3'd4;
  logic signed [SUM:0] total2;
  logic [LAST-1:0] last2;
  logic [2:0] kind1, kind2;
  voxmelt_pkg::cell_t cell1;
  logic signed [16:0] above1;
  sum_scan dut (
      .clk(clk), .rst(1'b0), .move(1'b1), .cell_in(cell_in), .bottom(bottom), .live4(1'b0), .hot(1'b0),
      .dither4(16'd0), .dither19(16'd0), .total2(total2), .last2(last2), .kind1(kind1), .kind2(kind2),
      .cell1(cell1), .above1(above1));
  logic [7:0] age;
  moves count (.clk(clk), .age(age));
  // The sum of the run's amounts, and of its cells, less one. No column has more than 4096 cells.
  logic [SUM-1:0] sum2;
  logic [LAST:0] cells2;
  always_ff @(posedge clk) begin
    sum2 <= kind1 == INNER ? sum2 + SUM'(cell1.amount) : SUM'(cell1.amount);
    cells2 <= kind1 == INNER ? cells2 + 13'd1 : 13'd1;
  end
  wire blocked1 = cell1.state == voxmelt_pkg::SOLID | cell1.state == voxmelt_pkg::INERT;
  wire signed [SUM:0] less = $signed({1'b0, sum2}) - $signed({4'd0, cells2, 12'd0});
  always_comb
    if (age == 8'd0) begin
      assume (above1 == $signed({1'b0, cell1.amount}) - 17'sd4096);
      assume (total2 == less);
      assume (13'(last2) + 13'd1 == cells2);
      assume (cells2 <= 13'd4095 && 41'(sum2) <= 41'(cells2) * 41'd65535);
    end
  always_comb if (age == 8'd1) begin
    sum_is_of_its_cells: assert (total2 == less);
    cells_are_counted: assert (13'(last2) + 13'd1 == cells2);
  end
  // A cell joins the run below it if that has more than it holds, or if it has some and the lower half is full.
  logic run_below;
  logic [15:0] below_amount;
  past #(.WIDTH(16), .N(1)) lower (.clk(clk), .d(cell1.amount), .q(below_amount));
  assign run_below = kind2 == FIRST | kind2 == INNER;
  always_comb if (age == 8'd1) begin
    joins_as_the_page: assert (blocked1 | kind2 < 3'd2 | (kind1 == INNER) == (run_below & ~on_floor1 &
        (total2 > 29'sd0 | (below_amount >= 16'd2048 & cell1.amount != 16'd0))));
    only_runs_on_ground: assert (kind1 != FIRST | on_floor1 | kind2 < 3'd2);
  end
  logic on_floor1;
  past #(.WIDTH(1), .N(1)) floors (.clk(clk), .d(bottom), .q(on_floor1));
endmodule
