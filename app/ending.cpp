#include "app/ending.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <new>
#include <string_view>
#include <system_error>

#include "app/message.h"
#include "app/options.h"
#include "kernel/automaton/step/stepper.h"
#include "kernel/run/checkpoint/blocks.h"
#include "kernel/run/io/file_writer.h"
#include "kernel/scene/scene.h"
#include "render/image/png.h"
#include "render/packet/draw_picture.h"

namespace voxmelt::app {
namespace {

// Tells if the system has no more of what it was asked for, or if a disk is full.
bool is_shortage(const std::error_code& code) {
  return code == std::errc::resource_unavailable_try_again || code == std::errc::not_enough_memory ||
         code == std::errc::no_space_on_device || code == std::errc::too_many_files_open ||
         code == std::errc::too_many_files_open_in_system;
}

// TBB has no type of its own for this, and ends its text with the words of the system.
bool is_shortage_of_threads(std::string_view text) {
  return text.starts_with("pthread_create") && text.ends_with(std::strerror(EAGAIN));
}

}  // namespace

bool ends_at_once() { return step::DeviceLost::happened; }

Ending ending_of(const std::exception_ptr& thrown) {
  try {
    std::rethrow_exception(thrown);
  } catch (const Interrupted& interrupted) {
    return {interrupted.what(), kInterrupted};
  } catch (const render::Stopped&) {
    return {Interrupted().what(), kInterrupted};
  } catch (const scene::InputError& error) {
    return {error.what(), kBadInput};
  } catch (const checkpoint::Error& error) {
    return {error.what(), kBadInput};
  } catch (const UsageError& error) {
    return {error.what(), kBadInput};
  } catch (const scene::ResourceError& error) {
    return {error.what(), kOutOfResources};
  } catch (const step::DeviceError& error) {
    return {std::string("error: ") + error.what(), kOutOfResources};
  } catch (const io::OutputError& error) {
    return {error.what(), error.out_of_space() ? kOutOfResources : kBadInput};
  } catch (const render::ImageError& error) {
    return {error.what(), error.out_of_space() ? kOutOfResources : kBadInput};
  } catch (const std::bad_alloc&) {
    return {"error: out of memory", kOutOfResources};
  } catch (const std::filesystem::filesystem_error& error) {
    return {place_message(error), is_shortage(error.code()) ? kOutOfResources : kBadInput};
  } catch (const std::system_error& error) {  // of threads, which the system does not give
    return {std::string("error: no thread can be had: ") + error.code().message(), kOutOfResources};
  } catch (const std::exception& error) {
    if (is_shortage_of_threads(error.what()))
      return {std::string("error: no thread can be had: ") + std::strerror(EAGAIN), kOutOfResources};
    return {std::string("error: ") + error.what(), kCheckFailed};
  }
}

}  // namespace voxmelt::app
