// The entry point on every machine.
#include "app/demo.h"

int main(int count, char** arguments)
{
    return demo(count, arguments);
}
