// SPDX-License-Identifier: Apache-2.0
// A plugin that says it was built with other headers.
#include "skein/assemble/kinds/plugin.h"

const skein::assemble::Plugin skein_plugin{{.headers = "000000000000"}, nullptr};
