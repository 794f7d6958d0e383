/// The exhibit's answers to the staff over its local socket, and the requests for them: docs/status.md.
///
/// Threads  the socket's own.
#pragma once

#include "app/show/screenshot.h"
#include "firmware_host/service/journal.h"
#include "firmware_host/service/staff_socket.h"

#include <filesystem>
#include <memory>
#include <string_view>

namespace frustumscreen::programs {

inline constexpr std::string_view usual_staff_socket = "/run/frustumscreen-staff/exhibit.sock";

/// `screenshot` must outlive it. Null if there is no path or the socket cannot be made; the journal says why.
[[nodiscard]] std::unique_ptr<service::StaffSocket> open_staff_socket(const std::filesystem::path& path,
                                                                      show::Screenshot& screenshot,
                                                                      const service::Journal& journal);

/// Returns a PNG. Errors: as ask_staff_socket.
[[nodiscard]] Result<Bytes> ask_for_screenshot(const std::filesystem::path& path);

} // namespace frustumscreen::programs
