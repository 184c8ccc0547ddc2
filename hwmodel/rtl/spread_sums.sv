// What the cells of a lane's window get from the pairs at position 22. A sum is {amount x heat, amount}. A
// pair's second cell gets the opposite of its first.
module spread_sums (
    input  logic        clk,
    input  logic        move,
    input  logic [47:0] up22,         // of this lane: q with sw
    input  logic [47:0] down22,       // w with s
    input  logic [47:0] along_x22,    // s with sw
    input  logic [47:0] next_up22,    // of the lane to the east, or 0
    input  logic [47:0] next_down22,
    input  logic [47:0] next_x22,
    input  logic [47:0] next_z22,     // w with sw
    output logic [47:0] here25,       // what q gets
    output logic [47:0] south25       // what s gets
);
  function automatic [47:0] sum(input [47:0] a, input [47:0] b);
    sum = {a[47:16] + b[47:16], a[15:0] + b[15:0]};
  endfunction
  function automatic [47:0] difference(input [47:0] a, input [47:0] b);
    difference = {a[47:16] - b[47:16], a[15:0] - b[15:0]};
  endfunction
  logic [47:0] here23, z23, here24, mine23, others23, x23, mine24, others24;
  always_ff @(posedge clk)
    if (move) begin
      here23 <= sum(up22, next_down22);
      z23 <= next_z22;
      here24 <= sum(here23, z23);
      here25 <= here24;

      mine23 <= difference(along_x22, down22);
      others23 <= sum(next_up22, next_z22);
      x23 <= next_x22;
      mine24 <= difference(mine23, x23);
      others24 <= others23;
      south25 <= difference(mine24, others24);
    end
endmodule
