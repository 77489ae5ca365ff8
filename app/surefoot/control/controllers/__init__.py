"""The controllers: two-part, QP for all joints, soft QP."""
