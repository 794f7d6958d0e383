/// The address of a local socket's file: unix(7).
///
/// Threads  values; any.
#pragma once

#include <sys/socket.h>
#include <sys/un.h>

#include <filesystem>
#include <optional>

namespace frustumscreen::service {

class UnixAddress {
public:
    /// nullopt if the path is empty or too long.
    [[nodiscard]] static std::optional<UnixAddress> of(const std::filesystem::path& path) {
        UnixAddress address;
        const std::string& text = path.native();
        if (text.empty() || text.size() >= sizeof(address.address_.sun_path)) {
            return std::nullopt;
        }
        address.address_.sun_family = AF_UNIX;
        text.copy(address.address_.sun_path, text.size());
        return address;
    }
    [[nodiscard]] const sockaddr* get() const { return reinterpret_cast<const sockaddr*>(&address_); }
    [[nodiscard]] socklen_t size() const { return sizeof(address_); }

private:
    sockaddr_un address_{};
};

} // namespace frustumscreen::service
