// List: the report's "simple linked-list data structure", for short lists that change while the program runs: the links of a
// SoftObject. A list owns its nodes.
#ifndef FB_LIST_H
#define FB_LIST_H

#include "rt.h"

template <class T>
class List {
public:
    struct Node {
        T item;
        Node* next;
    };

    List() = default;
    ~List() { clear(); }
    List(const List&) = delete;
    List& operator=(const List&) = delete;

    // Adds an item at the end. Returns false when there is no memory; the list is unchanged then.
    bool append(const T& item)
    {
        Node* node = static_cast<Node*>(malloc(sizeof(Node)));
        if (node == nullptr)
            return false;
        node->item = item;
        node->next = nullptr;
        Node** at = &head_;
        while (*at != nullptr)
            at = &(*at)->next;
        *at = node;
        return true;
    }

    // Removes the first item equal to `item`. Returns false if there is none.
    bool remove(const T& item)
    {
        for (Node** at = &head_; *at != nullptr; at = &(*at)->next) {
            if ((*at)->item == item) {
                Node* gone = *at;
                *at = gone->next;
                free(gone);
                return true;
            }
        }
        return false;
    }

    // Returns the first item equal to `item`, or null.
    T* find(const T& item)
    {
        for (Node* node = head_; node != nullptr; node = node->next)
            if (node->item == item)
                return &node->item;
        return nullptr;
    }

    void clear()
    {
        while (head_ != nullptr) {
            Node* gone = head_;
            head_ = gone->next;
            free(gone);
        }
    }

    Node* first() const { return head_; }
    bool empty() const { return head_ == nullptr; }

private:
    Node* head_ = nullptr;
};

#endif
