#include "base/trouble.h"

#include <new>
#include <system_error>

namespace brisance {
namespace {

bool meansNoRoom(const std::error_code& trouble) {
  return trouble == std::errc::no_space_on_device || trouble == std::errc::permission_denied ||
         trouble == std::errc::read_only_file_system || trouble == std::errc::not_enough_memory;
}

}  // namespace

Trouble troubleAtHand() {
  try {
    throw;
  } catch (const Error& trouble) {
    return {trouble.code, trouble.what()};
  } catch (const std::bad_alloc&) {
    return {ExitCode::noRoom,
            "brisance: not enough memory; make the grids of the scene smaller (brisance check tells the need)"};
  } catch (const std::system_error& trouble) {
    return {meansNoRoom(trouble.code()) ? ExitCode::noRoom : ExitCode::failed,
            fmt::format("brisance: {}", trouble.what())};
  } catch (const std::exception& trouble) {
    return {ExitCode::failed, fmt::format("brisance: {}", trouble.what())};
  }
}

}  // namespace brisance
