#include "layer/reasoning/agent/zone_guard.h"
