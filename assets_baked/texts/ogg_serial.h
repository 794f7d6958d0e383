/// Gives an Ogg stream a serial number of our choice.
///
/// Threads  pure; any.
/// Source   RFC 3533, section 6: the page's header and its checksum.
#pragma once

#include "firmware_host/base/file.h"

#include <cstdint>

namespace frustumscreen {

/// `ogg` is whole pages of one stream, as an encoder wrote them; what follows a page that is none stays as it is.
void set_ogg_serial(Bytes& ogg, std::uint32_t serial);

} // namespace frustumscreen
