// SPDX-License-Identifier: Apache-2.0
// The only symbol that a plugin needs: what it was built for, and how to add its kinds.
#include "skein/assemble/kinds/plugin.h"

#include "my_kinds.h"

const skein::assemble::Plugin skein_plugin{{}, my_kinds::add_kinds};
