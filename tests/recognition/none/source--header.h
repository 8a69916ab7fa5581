#ifndef AXIS_H
#define AXIS_H
#include <stdint.h>
void move(int x, int y);
#endif
