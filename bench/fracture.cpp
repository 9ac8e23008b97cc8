// What breaking costs, beside peers on the same input in the same run (rows as What/Input/Size/Who).
// Each subject has a file of its own: fracture_NAME.cpp.
