#include "tests/render/device/plain_kernels.h"

#include <iterator>
#include <span>

#include "render/device/kernels.h"

namespace voxmelt::render {
namespace {

#include "tests/kernel/engine/gpu/plain_dialect.h"

#include "render/device/program/all.cl"

#define CALL(name) (&gpu::Unpacked<&(name)>::call)
constexpr gpu::Call kCalls[] = {
    CALL(find_columns), CALL(begin_levels), CALL(smooth_levels),  CALL(put_matter),    CALL(fill_columns),
    CALL(fill_rim),     CALL(filter_axis),  CALL(keep_intensity), CALL(mix_intensity), CALL(prefilter_x),
    CALL(prefilter_y),  CALL(make_levels),  CALL(find_shares),    CALL(find_blocks),   CALL(spread_blocks),
    CALL(find_density), CALL(sweep_u),      CALL(sweep_v),        CALL(begin_lamp),    CALL(pass_lamp),
    CALL(soften_lamp),  CALL(draw_middles), CALL(find_differing), CALL(refine)};
static_assert(std::size(kCalls) == std::size(kPictureKernelNames));

}  // namespace

std::span<const gpu::Call> plain_picture_kernels() { return kCalls; }

}  // namespace voxmelt::render
