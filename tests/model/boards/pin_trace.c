/* Run a program for the ATmega328P in simavr, and print the edges of a pin of port B.
 *
 * pin_trace PROGRAM PIN EDGES CYCLES: one line an edge, the cycle of the clock and the level, until
 * so many edges or cycles have passed; then the cycles of the longest interrupt of timer 1, and 2.
 * The processor sleeps between its interrupts, so that the simulator takes each compare match in its
 * own cycle and not after some longer instruction.
 */
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include <simavr/avr_ioport.h>
#include <simavr/sim_avr.h>
#include <simavr/sim_elf.h>

static avr_t *processor;
static unsigned long edges_left;
static uint32_t level = 0;
static int pin;
static avr_cycle_count_t begun = 0, longest = 0;

#define TIMER1_COMPA 11

static void on_pin(struct avr_irq_t *irq, uint32_t value, void *argument)
{
    (void)irq;
    (void)argument;
    avr_ioport_state_t port;
    avr_ioctl(processor, AVR_IOCTL_IOPORT_GETSTATE('B'), &port);
    const int is_output = port.ddr >> pin & 1;
    if (!is_output || value == level || edges_left == 0)
        return;
    level = value;
    --edges_left;
    printf("%llu %u\n", (unsigned long long)processor->cycle, (unsigned)value);
}

static void on_interrupt(struct avr_irq_t *irq, uint32_t value, void *argument)
{
    (void)irq;
    (void)argument;
    if (value)
        begun = processor->cycle;
    else if (processor->cycle - begun > longest)
        longest = processor->cycle - begun;
}

/* Sleep for simulated time only: the simulator's own waits for as long as the board would. */
static void skip(avr_t *sleeping, avr_cycle_count_t cycles)
{
    (void)sleeping;
    (void)cycles;
}

static void say_nothing(avr_t *speaker, const int kind, const char *format, va_list arguments)
{
    (void)speaker;
    if (kind <= LOG_ERROR && kind != LOG_OUTPUT)
        vfprintf(stderr, format, arguments);
}

int main(int count, char **words)
{
    if (count != 5)
        return 2;
    elf_firmware_t program = {{0}};
    avr_global_logger_set(say_nothing);
    if (elf_read_firmware(words[1], &program) != 0)
        return 3;
    pin = atoi(words[2]);
    edges_left = strtoul(words[3], NULL, 10);
    const avr_cycle_count_t last = strtoull(words[4], NULL, 10);
    processor = avr_make_mcu_by_name("atmega328p");
    if (processor == NULL)
        return 4;
    avr_init(processor);
    processor->frequency = 16000000;
    avr_load_firmware(processor, &program);
    processor->sleep = skip;
    avr_irq_register_notify(
        avr_io_getirq(processor, AVR_IOCTL_IOPORT_GETIRQ('B'), pin), on_pin, NULL);
    avr_irq_register_notify(
        avr_get_interrupt_irq(processor, TIMER1_COMPA) + AVR_INT_IRQ_RUNNING, on_interrupt, NULL);
    while (edges_left > 0 && processor->cycle < last) {
        const int state = avr_run(processor);
        if (state == cpu_Done || state == cpu_Crashed)
            return 5;
    }
    printf("%llu 2\n", (unsigned long long)longest);
    return 0;
}
