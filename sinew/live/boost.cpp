// The parts of Boost's Asio and Beast that are no templates, compiled once for the server's files.
#include <boost/asio/impl/src.hpp>
#include <boost/beast/src.hpp>
