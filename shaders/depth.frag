// Of surfaces that keep off all light: their depth is all that is drawn.
#version 450 core

void main() {}
