// The order of the stream: no place lies between one and the next.
module proof (
    input logic clk,
    input voxmelt_pkg::place_t place,
    input voxmelt_pkg::place_t last,
    input voxmelt_pkg::place_t other,
    input logic wraps
);
  voxmelt_pkg::place_t next;
  place_after dut (.place(place), .last(last), .wraps(wraps), .after(next));
  logic [7:0] age;
  moves time_ (.clk(clk), .age(age));
  function automatic valid(input [35:0] a);
    valid = a[11:0] <= last.y && a[23:12] <= last.block && a[35:24] <= last.plane;
  endfunction
  wire ends = place == last;
  always_comb if (age == 8'd0) begin
    assume (valid(place) && valid(other));
    assume (last.plane != 12'hFFF && last.block != 12'hFFF && last.y != 12'hFFF);
    none_between: assert (ends | ~(other > place && other < next));
    stays_inside: assert (ends | (valid(next) && next > place));
    begins_again: assert (~ends | ~wraps | next == '0);
  end
endmodule
