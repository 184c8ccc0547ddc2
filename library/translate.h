// Errors of the inner rooms are translated into those of the public face.
#pragma once

#include <filesystem>
#include <new>

#include "kernel/run/checkpoint/blocks.h"
#include "kernel/run/io/output_folder.h"
#include "kernel/scene/text/error.h"
#include "render/image/png.h"
#include "render/packet/draw_picture.h"
#include "voxmelt/errors.h"

namespace voxmelt::library {

template <class Error>
[[noreturn]] void throw_unwritten(const Error& error) {
  if (error.out_of_space()) throw ResourceError(error.what());
  throw OutputError(error.what());
}

// Returns the result of `work`. An exception from it is thrown on as one of the public errors.
template <class Work>
decltype(auto) translated(const Work& work) {
  try {
    return work();
  } catch (const scene::InputError& error) {
    throw InputError(error.what());
  } catch (const checkpoint::Error& error) {
    throw InputError(error.what());
  } catch (const scene::ResourceError& error) {
    throw ResourceError(error.what());
  } catch (const io::OutputError& error) {
    throw_unwritten(error);
  } catch (const render::ImageError& error) {
    throw_unwritten(error);
  } catch (const render::Stopped&) {
    throw Stopped();
  } catch (const std::filesystem::filesystem_error& error) {
    throw OutputError(error.what());
  } catch (const std::bad_alloc&) {
    throw ResourceError("error: out of memory");
  }
}

}  // namespace voxmelt::library
