// Where every machine enters the program.
#include "app/demo.h"

int main(int count, char** arguments)
{
    return demo(count, arguments);
}
