/// Output of minisign 0.11: keys, and signatures of the six bytes "hello\n".
#pragma once

#include <string_view>

namespace frustumscreen::vectors {

inline constexpr std::string_view signed_text = "hello\n";

inline constexpr std::string_view open_key =
    "untrusted comment: minisign encrypted secret key\n"
    "RWQAAEIyAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAonuJh4y3aA4L1gKMaqr821RuXL305L3C"
    "iy3ESjHF3OhhKhiLrl5r1QFygpvWxkFKDOTJgi5VklPjkmLVcy4pfr8p961f7U5VAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA"
    "AAA=\n";
inline constexpr std::string_view open_public = "untrusted comment: minisign public key E68B78C87897BA2\n"
                                                "RWSie4mHjLdoDgFygpvWxkFKDOTJgi5VklPjkmLVcy4pfr8p961f7U5V\n";
inline constexpr std::string_view open_id = "E68B78C87897BA2";

/// By the key above: one over the hash, and one over the bytes themselves.
inline constexpr std::string_view of_the_hash =
    "untrusted comment: signature from minisign secret key\n"
    "RUSie4mHjLdoDsBEsuBz4xSrzzq7Mhox8wphCHDd+1CpA8j1qkiXcoERerfb94rTZAUUGgNYpVyceSEk1uvA8dLgB1wOK3y3DgY=\n"
    "trusted comment: timestamp:1795419910\tfile:a\thashed\n"
    "hWz0z8EyjXLir+kaYW9EHWMpnaLAa7357rNauz9JU6vB76T9E/llCJ9zGXUdSWGeUxVNK/kkvfrwuhCyLwnoDA==\n";
inline constexpr std::string_view of_the_bytes =
    "untrusted comment: signature from minisign secret key\n"
    "RWSie4mHjLdoDlNRtKpyQwZKf3dp/WJWI+3GDWcwb2LXtEOQ2WQeXTaIvirGLTsNz0objXYwTSLosFaHJIKSIHi6saYIsh8zWw4=\n"
    "trusted comment: timestamp:1795419910\tfile:a\n"
    "gTDB2QUm/Xq9VvZveqbsVpcgz44GNF8fxPHl0n/vTBhBca0KvdCXqNBVOg4z+rmCIHQD4oRahfjwz9eikyDwBA==\n";

/// With the password "pw".
inline constexpr std::string_view encrypted_key =
    "untrusted comment: minisign encrypted secret key\n"
    "RWRTY0Iykg9SVwMBXC+M3bOFjAmiykQuD30FXAWuiteegMblxl8AAAACAAAAAAAAAEAAAAAA4hcRgMkdDX57MaY74J/YUB/EoSDyZR50"
    "13l2ujdPjy6KXz3u0Ztnxpf4W2/ZR+ekeTl7N63qf7ZCnQT7RkD22E5TE6VNt0w+ZPQIIVHwDrXyN/2wRgynBoLtks5AkpyveUVAFolX"
    "QvI=\n";
inline constexpr std::string_view encrypted_public =
    "RWThQNrYvqbZ4PTitPxWOvETfS9Ql0KWowX3+Vvq/28jm9nLWC8vMSEN";

} // namespace frustumscreen::vectors
