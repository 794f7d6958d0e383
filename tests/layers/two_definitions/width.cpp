namespace two_definitions {

struct Box {
    double width = 2.0;
};

double width() {
    const Box box;
    return box.width;
}

} // namespace two_definitions
