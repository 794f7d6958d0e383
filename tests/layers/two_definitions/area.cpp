namespace two_definitions {

double width();

struct Box {
    int left = 0;
    int right = 3;
};

} // namespace two_definitions

int main() {
    const two_definitions::Box box;
    return static_cast<int>(two_definitions::width()) * (box.right - box.left);
}
