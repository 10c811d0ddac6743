// Tests of the linked list.
#include "math/list.h"

#include "test.h"

TEST(list_keeps_order)
{
    List<int> list;
    CHECK(list.empty());
    CHECK(list.first() == nullptr);
    for (int i = 0; i < 5; ++i)
        CHECK(list.append(i));
    CHECK(!list.empty());
    int expected = 0;
    for (List<int>::Node* node = list.first(); node != nullptr; node = node->next)
        SAME(node->item, expected++);
    SAME(expected, 5);
}

TEST(list_removes)
{
    List<int> list;
    CHECK(!list.remove(1));
    for (int item : {1, 2, 3, 2, 4})
        CHECK(list.append(item));
    CHECK(list.remove(2));  // the first of the two
    CHECK(list.remove(1));
    CHECK(list.remove(4));
    CHECK(!list.remove(9));
    CHECK(list.first()->item == 3);
    CHECK(list.first()->next->item == 2);
    CHECK(list.first()->next->next == nullptr);
    CHECK(list.append(5));
    CHECK(list.first()->next->next->item == 5);
    list.clear();
    CHECK(list.empty());
    list.clear();
}

TEST(list_finds)
{
    List<int> list;
    CHECK(list.find(3) == nullptr);
    for (int item : {3, 1, 3})
        CHECK(list.append(item));
    CHECK(list.find(3) == &list.first()->item);
    CHECK(list.find(1) == &list.first()->next->item);
    CHECK(list.find(2) == nullptr);
    *list.find(1) = 8;
    CHECK(list.find(8) != nullptr);
}
