#include "layer/reasoning/agent/monitor_agent.h"
