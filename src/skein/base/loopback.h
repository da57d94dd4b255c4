// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace skein {

/// Whether a host is this machine by an address that other machines cannot reach, or by
/// the name of one; all who let programs of this machine alone in decide by this.
///
/// Such are `localhost`, 127.0.0.0/8, `::1`, and the IPv4 ones as an IPv6 socket has them
/// (`::ffff:127.0.0.1`); IPv6 with or without brackets, in any spelling.
/// Reference: RFC 1122, section 3.2.1.3; RFC 4291, sections 2.5.3 and 2.5.5.2; RFC 6761,
/// section 6.3.
bool is_loopback(std::string_view host);

}  // namespace skein
