// Reverses columns: what comes bottom first leaves top first, a column later. One address serves both ports:
// the old word is read, then the new one takes its place. After every column the address turns round.
module column_reverser #(
    parameter WIDTH = 1,
    parameter DEPTH = 4096  // the highest column
) (
    input  logic             clk,
    input  logic             rst,
    input  logic             restart,  // the next word is the first one of a pass
    input  logic             en,       // a word comes, and one leaves
    input  logic [11:0]      last_y,
    input  logic [WIDTH-1:0] d,
    input  logic             pass,     // of d; a column has one
    output logic [WIDTH-1:0] q,        // in the next move, as those below
    output logic [11:0]      at_q,     // how many words of its column left before it
    output logic             pass_q
);
  localparam ADDRESS = DEPTH > 1 ? $clog2(DEPTH) : 1;
  logic [WIDTH-1:0] words[0:DEPTH-1];
  logic [ADDRESS-1:0] at;
  logic [11:0] done;
  logic turned, pass_written;
  wire first = done == 12'd0, ends = done == last_y;

  always_ff @(posedge clk) begin
    if (rst | restart) begin
      at <= '0;
      done <= 12'd0;
      turned <= 1'b0;
    end else if (en) begin
      done <= ends ? 12'd0 : done + 12'd1;
      if (ends) turned <= ~turned;
      else at <= turned ? at - ADDRESS'(1) : at + ADDRESS'(1);
    end
    if (en) begin
      at_q <= done;
      if (first) begin
        pass_q <= pass_written;
        pass_written <= pass;
      end
    end
  end

  always_ff @(posedge clk)
    if (en) begin
      q <= words[at];
      words[at] <= d;
    end
endmodule
