/// Sets the serial number of an Ogg stream.
///
/// Threads  pure; any.
/// Source   RFC 3533, section 6: the page's header and its checksum.
#pragma once

#include "firmware_host/base/file.h"

#include <cstdint>

namespace frustumscreen::texts {

/// `ogg` is whole pages of one stream, as written by an encoder. Bytes from the first invalid page on stay
/// unchanged.
void set_ogg_serial(Bytes& ogg, std::uint32_t serial);

} // namespace frustumscreen::texts
