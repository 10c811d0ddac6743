// Where every machine enters the program.
#include "demo.h"

int main(int count, char** arguments)
{
    return demo(count, arguments);
}
