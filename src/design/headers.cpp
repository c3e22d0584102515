#include "design/operations/operations.h"
#include "karinui/design/history.h"
#include "karinui/design/script.h"
